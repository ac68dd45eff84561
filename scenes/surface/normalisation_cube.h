// The normalisation cube map. Each texel holds the unit vector of its direction, so that a lookup
// normalises a vector (Voorhies and Foran 1994). The same texels go to OpenGL.
#pragma once

#include "scenes/cube_map.h"
#include "scenes/roundoff.h"

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// Each face of size x size texels. A texel is round(255 (0.5 + 0.5 n)) of the unit vector n
/// through its centre.
struct NormalisationCube {
    int size = 0;
    CubeFaces<glm::u8vec3> faces{};
};
NormalisationCube make_normalisation_cube(int size);

/// The result of a lookup: 2 rgb - 1 of the interpolated texels. Zero where the vector is zero.
glm::dvec3 looked_up(const NormalisationCube& cube, const glm::dvec3& vector);

/// Error bound of one component of a lookup computed in floats, in a cube of `size` texels a side:
/// the place among the texels is rounded three times, by up to `size` units of 2^-24, and
/// neighbours differ by 4/size and a step of 2/255 at most; the interpolation's own four roundings
/// are of numbers up to 1.
constexpr double cube_lookup_error(int size) {
    return 3 * size * float_roundoff * 2 * (4.0 / size + 2 / 255.0) + 8 * float_roundoff;
}

} // namespace shadowproof
