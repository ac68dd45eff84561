// How large a bump map's texels are on a surface: the parametric derivatives that stretch bumps.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The way over a triangle from one texel to the next, along a row and down the rows: P_u and P_v
/// of Blinn 1978, in units of the scene per texel. Zero where the triangle has no area in the
/// texture.
struct TexelSides {
    glm::dvec3 along{0, 0, 0};
    glm::dvec3 down{0, 0, 0};
};
TexelSides texel_sides(const Scene& scene, std::uint32_t triangle);

/// The gradient of heights over a surface, per unit of the scene: the vector across `normal` (unit)
/// whose way along each side makes the slope along it (heights per texel; heights in units of the
/// scene):
///
///     G = (slope.x (P_v x N) + slope.y (N x P_u)) / (N . (P_u x P_v))
///
/// The perturbed normal is N - G, not normalised: Blinn's N + (h_u (N x P_v) + h_v (P_u x N)), over
/// the area of a texel. Zero where the sides span no area across the normal.
glm::dvec3 height_gradient(const TexelSides& sides, const glm::dvec3& normal,
                           const glm::dvec2& slope);

/// A material's texels are squares of this side, were their area on all its triangles the same:
/// the root of area in space over area in texels. By it, heights in units of the scene are taken
/// for heights in texels where the sides of each triangle's texels are not known. 1 where there is
/// no area.
double mean_texel_side(const Scene& scene, const Material& material);

} // namespace shadowproof
