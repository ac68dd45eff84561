// The surface that a technique shows, beside its claim: what was cleared to where it shows none;
// else a triangle that is drawn, at the depth of its plane.
#pragma once

#include "reference/trace.h"
#include "scenes/frame.h"

#include <cstdint>

namespace shadowproof {

/// Window depth of what lies at an inverse view depth.
double window_depth(const DepthModel& model, double inverse_depth);

/// Whether a triangle may show the eye a side that is drawn, with corners moved by up to `freedom`
/// a component of a direction: snapping may turn over what is seen edge-on.
bool may_be_drawn(const Tracer& tracer, std::uint32_t triangle, double freedom);

/// The part of a pixel's surface that its own triangle decides; whether another one hides it is
/// for the band to tell. Keeps references to all.
class SurfaceCheck {
public:
    SurfaceCheck(const Tracer& tracer, const Frame& frame, double far)
        : tracer_(tracer), frame_(frame), far_(far) {}

    /// Depth and triangle of pixel (x, y) as they may be read back: the triangle is drawn and lies
    /// within near and far plane, the buffer has the format that the technique counts on, and the
    /// depth is what it keeps of the plane's, anywhere that lateral_freedom reaches, give or take
    /// depth_freedom and setup_freedom.
    bool holds(int x, int y) const;

private:
    const Tracer& tracer_;
    const Frame& frame_;
    double far_;

    bool has_format() const;
};

} // namespace shadowproof
