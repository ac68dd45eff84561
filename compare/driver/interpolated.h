// Values interpolated over a triangle at a pixel, with error bounds for a rasterizer's snapping and
// rounding.
#pragma once

#include "compare/driver/interval.h"
#include "compare/driver/quad_steps.h"
#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace shadowproof {

/// The part of a triangle that a rasterizer may draw at a pixel, as weights of the triangle's
/// corners, which add up to 1. Interpolated values are linear over the triangle, and straight lines
/// of the picture are straight on it: over a polygon of the picture they are extreme at its
/// corners.
struct PixelSpread {
    glm::dvec3 middle{1, 0, 0};          ///< a place in the polygon
    std::array<glm::dvec3, 4> corners{}; ///< of the polygon
    bool aside = false;                  ///< whether there is a polygon, not the middle alone
    double share = 0;                    ///< relative rounding error: attribute_error
    std::optional<QuadRays> quad{};      ///< where steps between neighbours count
};

/// The weights where a line of sight meets the triangle's plane; none of them is clamped.
/// Not finite if it does not meet it.
glm::dvec3 weights_along(const Scene& scene, std::uint32_t triangle, const glm::dvec3& line);

/// Values at the middle, with error bounds. No vector is normalised.
struct Interpolated {
    glm::dvec3 from_eye{0, 0, 0}; ///< Q of shading.h, or the direction of parallel lines of sight
    glm::dvec3 to_light{0, 0, 0}; ///< vector to the light, or its direction
    glm::dvec3 normal{0, 0, 0};
    glm::dvec3 tangent{0, 0, 0};
    double from_eye_off = 0;
    double to_light_off = 0;
    double normal_off = 0;
    double tangent_off = 0;
    PlaceRange bump_at{};
    PlaceRange decal_at{};
    PlaceSteps bump_steps{}; ///< any, without a quad
    PlaceSteps decal_steps{};
};

/// The three corners' surfaces, as the scene has them.
inline std::span<const Surface, 3> corners_of(const std::vector<Surface>& surfaces,
                                              std::uint32_t triangle) {
    return std::span<const Surface, 3>(&surfaces[std::size_t{3} * triangle], 3);
}

/// `corners`: of the triangle, with what is interpolated.
Interpolated interpolated_at(const Scene& scene, std::uint32_t triangle,
                             std::span<const Surface, 3> corners, const PixelSpread& spread);

} // namespace shadowproof
