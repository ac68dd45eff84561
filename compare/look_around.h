// What may be drawn at pixels whose centres do not tell: around them, across outlines that the
// clipper displaces and, at last, by the errors of all that is drawn.
#pragma once

#include "compare/driver/cut_surfaces.h"
#include "compare/judge/judge.h"

#include <vector>

namespace shadowproof {

/// A claim, and the judge of its family.
struct Case {
    JudgedClaim claim;
    const Judge& judge;
    CutSurfaces cut{claim.traced.tracer(), claim.frame.depth_model, claim.traced.far()};

    const Tracer& tracer() const { return claim.traced.tracer(); }
};

/// What is found, place by place, of places that it sorts: by regions of the picture, so that the
/// first ones are spread over it. Where that becomes hopeless, the others stay as their centres
/// left them: unexplained.
std::vector<Finding> look_around(const Case& tried, std::vector<PixelPlace>& places);

} // namespace shadowproof
