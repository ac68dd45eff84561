#include "raster/volume.h"

#include "scenes/topology.h"

#include <cassert>
#include <glm/geometric.hpp>

namespace shadowproof {

double side(const Scene& scene, std::uint32_t triangle, const glm::dvec3& point) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 ab = corner(scene, triangle, 1) - a;
    const glm::dvec3 ac = corner(scene, triangle, 2) - a;
    return glm::dot(glm::cross(ab, ac), point - a);
}

std::vector<std::uint32_t> triangles_facing_light(const Scene& scene) {
    const glm::dvec3 light = chosen_light(scene).position;
    std::vector<std::uint32_t> facing;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        if (side(scene, triangle, light) > 0) facing.push_back(triangle);
    return facing;
}

ShadowVolume extrude(const Scene& scene) {
    assert(chosen_light(scene).kind != Light::Kind::directional);
    const auto at_infinity = static_cast<std::uint32_t>(scene.positions.size());
    const std::vector<std::uint32_t> facing = triangles_facing_light(scene);

    ShadowVolume volume;
    volume.light_cap.reserve(facing.size());
    volume.dark_cap.reserve(facing.size());
    for (const std::uint32_t triangle : facing) {
        const glm::uvec3 corners = scene.triangles[triangle];
        volume.light_cap.push_back(corners);
        volume.dark_cap.emplace_back(corners.z + at_infinity, corners.y + at_infinity,
                                     corners.x + at_infinity);
    }
    // A light cap runs along its edge from a to b, so the side beside it runs from b to a.
    for (const auto& [a, b, surplus] : boundary(scene, weld_by_position(scene.positions), facing)) {
        for (int i = 0; i < surplus; ++i) {
            volume.sides.emplace_back(b, a, a + at_infinity);
            volume.sides.emplace_back(b, a + at_infinity, b + at_infinity);
        }
    }
    return volume;
}

} // namespace shadowproof
