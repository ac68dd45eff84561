// How much one of the units of OpenGL's polygon offset is, which OpenGL leaves to the driver where
// depths are stored in fixed point.
#pragma once

#include "raster/gl/gl.h"
#include "scenes/shadow_map.h"

namespace shadowproof {

/// Measured: a triangle of one depth is drawn into a texture of the format with many units, and
/// read back. Of floats OpenGL says what it is, and nothing is drawn. Leaves viewport, framebuffer,
/// program and polygon offset changed.
OffsetUnit measured_offset_unit(const GlFunctions& gl, MapFormat format);

} // namespace shadowproof
