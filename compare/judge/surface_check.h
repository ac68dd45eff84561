// Checks the surface that a technique shows: a triangle that may be drawn, at the depth of its
// plane; or, where it shows none, the values to which the buffers were cleared.
#pragma once

#include "compare/driver/plane_at_pixel.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>

namespace shadowproof {

/// Whether the eye may see a side of the triangle that is drawn, with corners moved by up to
/// `error` a component of a line of sight: snapping may flip a triangle that is seen edge-on.
bool may_be_drawn(const Tracer& tracer, std::uint32_t triangle, double error);

/// Checks what a pixel's own triangle decides. Whether another triangle hides it is decided by the
/// band. Keeps references to all arguments.
class SurfaceCheck {
public:
    SurfaceCheck(const Tracer& tracer, const Frame& frame, double far);

    /// Whether depth and triangle of pixel (x, y) may be read back like this: the triangle is drawn
    /// and lies between near and far plane, the buffer has the technique's depth format, and the
    /// depth is that of the triangle's plane somewhere within lateral_error, to within depth_error
    /// and setup_error.
    bool holds(int x, int y) const;

private:
    const Tracer& tracer_;
    const Frame& frame_;
    DepthPicture picture_;

    bool has_format() const;
};

} // namespace shadowproof
