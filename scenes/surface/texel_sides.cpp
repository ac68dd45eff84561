#include "scenes/surface/texel_sides.h"

#include "scenes/surface/plane_equations.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

std::array<glm::dvec3, 3> positions_of(const Scene& scene, std::uint32_t triangle) {
    return {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)};
}

/// Of the bump map, in texels.
std::array<glm::dvec2, 3> places_of(const Scene& scene, std::uint32_t triangle) {
    const Material& material = scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
    const Image<glm::vec4>& texels = scene.textures[material.bump_map].texels;
    const Surface* const corners = &scene.surfaces[std::size_t{3} * triangle];
    std::array<glm::dvec2, 3> places{};
    for (std::size_t k = 0; k < 3; ++k)
        places[k] = glm::dvec2(corners[k].bump_at) * glm::dvec2(texels.width, texels.height);
    return places;
}

} // namespace

TexelSides texel_sides(const Scene& scene, std::uint32_t triangle) {
    const PlaneEquations planes =
        plane_equations(positions_of(scene, triangle), places_of(scene, triangle));
    if (planes.a == 0) return {};
    return {-planes.b / planes.a, -planes.c / planes.a};
}

glm::dvec3 height_gradient(const TexelSides& sides, const glm::dvec3& normal,
                           const glm::dvec2& slope) {
    const double area = glm::dot(normal, glm::cross(sides.along, sides.down));
    if (area == 0) return glm::dvec3(0);
    return (slope.x * glm::cross(sides.down, normal) + slope.y * glm::cross(normal, sides.along)) /
           area;
}

double mean_texel_side(const Scene& scene, const Material& material) {
    double in_space = 0;
    double in_texels = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (&scene.materials[mesh.material] != &material) continue;
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
            const std::uint32_t triangle = mesh.first_triangle + i;
            const std::array<glm::dvec3, 3> at = positions_of(scene, triangle);
            const PlaneEquations planes = plane_equations(at, places_of(scene, triangle));
            in_texels += std::abs(planes.a);
            in_space += glm::length(glm::cross(at[1] - at[0], at[2] - at[0]));
        }
    }
    const double side = std::sqrt(in_space / in_texels);
    return side > 0 && std::isfinite(side) ? side : 1;
}

} // namespace shadowproof
