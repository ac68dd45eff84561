// Lower and upper bounds of the number of volume faces that cover each pixel, and of those that are
// not behind what is seen there.
#pragma once

#include "compare/stencil/figures/drawn_faces.h"
#include "compare/stencil/figures/figure_range.h"
#include "scenes/frame.h"
#include "scenes/image.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

struct FaceCounts {
    FigureRange fragments; ///< of all faces, hidden or not
    /// Faces that are not behind what `frame` shows there. Empty where only fragments were asked
    /// for.
    Image<std::int32_t> low;
    Image<std::int32_t> high;
};

/// What is drawn, and how. `casters`: as counted_casters gives them; `far_ends`: where their
/// positions lie once extruded, null where that is at infinity; `far`: the far plane of techniques
/// that have a finite one.
struct DrawnPicture {
    const Scene& casters;
    const std::vector<glm::vec3>* far_ends = nullptr;
    const DrawnFaces& faces;
    const Frame& frame; ///< counting, depth model, near plane; depths and triangles for the order
    double far = 0;
};

FaceCounts count_faces(const DrawnPicture& picture, int threads);
/// Without low and high; of the frame, only how it is made matters.
FigureRange count_fragments(const DrawnPicture& picture, int threads);

} // namespace shadowproof
