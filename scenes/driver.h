// How often an OpenGL driver rounds, and to which grid it snaps: with roundoff.h the constants that
// every bound of its errors is made of. Bounds for the judge are derived in compare/driver, those
// for what is decided before drawing in scenes/plan and scenes/mesh; bytes are in
// scenes/byte_blending.h.
#pragma once

#include "scenes/roundoff.h"

#include <cmath>

namespace shadowproof {

/// Of one coordinate that a float matrix transforms: its entry (1), the product (1), the sums (3).
inline constexpr int transform_roundings = 5;

/// At each plane that clips, a new corner's coordinate is divided, subtracted, multiplied and
/// added.
inline constexpr int clipping_roundings = 4;

/// Of window depth, in units of its largest value: at 1/w, z/w and the viewport's sum, at the pixel
/// in two products and two sums of its plane, and half a step of fixed point. That is 7.5.
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
