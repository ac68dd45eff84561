#include "raster/eye_count.h"

#include "raster/volume.h"

#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// Whether the way from a point to the light (l, w) meets a triangle that faces the light: the
/// point lies behind the triangle, and on the inner side of the three planes through light and
/// edges.
bool shadows(const Scene& scene, std::uint32_t triangle, const glm::dvec4& light,
             const glm::dvec3& point) {
    if (side(scene, triangle, glm::dvec4(point, 1)) >= 0) return false;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 a = corner(scene, triangle, k);
        const glm::dvec3 b = corner(scene, triangle, (k + 1) % 3);
        const glm::dvec3 plane = glm::cross(light.w * a - glm::dvec3(light), b - a);
        if (glm::dot(plane, point - a) > 0) return false;
    }
    return true;
}

} // namespace

std::size_t volumes_around_eye(const Scene& scene) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    std::size_t count = 0;
    for (const std::uint32_t triangle : triangles_facing_light(scene))
        count += shadows(scene, triangle, light, scene.camera.eye) ? 1U : 0U;
    return count;
}

} // namespace shadowproof
