// Whether an alpha mask leaves a surface standing where a ray meets it: the sign of alpha there
// less what alpha must be (AlphaMask::least), exactly.
#pragma once

#include "reference/exact/mask_reading.h"
#include "reference/exact/predicates.h"
#include "scenes/scene.h"

#include <array>
#include <glm/vec2.hpp>

namespace shadowproof {

/// A triangle with a mask.
struct MaskedTriangle {
    Corners corners;
    std::array<glm::dvec2, 3> at; ///< its corners' texture coordinates
    const AlphaMask* mask = nullptr;
};

/// Signs of alpha - least: the surface stands where they are not negative. Where the eye ray meets
/// the triangle's plane, which may not hold the ray's direction; degree 3, over the sum of weights.
Decision mask_on_ray(Filters filters, const EyeRay& ray, const MaskedTriangle& triangle);
/// Where the line from the light to the point meets it. Degree 6, likewise.
Decision mask_before_light(Filters filters, const EyeRay& ray, const RayPoint& q,
                           const MaskedTriangle& triangle);

/// Whether the surface stands at least, or at most, for another program that reads the mask on the
/// eye ray with these errors, and interpolates between equal texels without any. `reading`: not
/// exact.
bool may_stand_on_ray(const EyeRay& ray, const MaskedTriangle& triangle, const MaskError& error,
                      MaskReading reading);

} // namespace shadowproof
