// How often an OpenGL driver rounds, and to which grid it snaps. All bounds of its errors are made
// of these constants and those of roundoff.h. Bounds for the judge are derived in compare/driver,
// those for what is decided before drawing in scenes/plan and scenes/mesh; bytes are in
// scenes/byte_blending.h.
#pragma once

#include "scenes/roundoff.h"

#include <cmath>

namespace shadowproof {

/// Roundings of one coordinate that a float matrix transforms: matrix entry (1), product (1), sums
/// (3).
inline constexpr int transform_roundings = 5;

/// Roundings of a new corner's coordinate at each plane that clips: a division, a subtraction, a
/// multiplication and an addition.
inline constexpr int clipping_roundings = 4;

/// Roundings of window depth, in units of its largest value: 1/w, z/w and the viewport's sum, two
/// products and two sums of its plane at the pixel, and half a step of fixed point: 7.5 together.
inline constexpr int window_depth_roundings = 8;

/// The relative error of a number that is kept as the sum of two floats.
inline constexpr double two_floats_roundoff = 0x1p-47;

/// A float product that comes out smaller than this may be flushed to 0.
inline constexpr double float_underflow = 0x1p-126;

/// Vertices are snapped to a grid of 2^-subpixel_bits of a pixel: how far that moves a coordinate.
inline double half_snapping_step(int subpixel_bits) {
    return std::exp2(-subpixel_bits - 1);
}

} // namespace shadowproof
