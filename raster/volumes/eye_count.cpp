#include "raster/volumes/eye_count.h"

#include "raster/volumes/volume.h"
#include "scenes/orientation.h"

namespace shadowproof {

namespace {

/// Whether the line from a place to the light (l, w) meets a triangle that faces the light: the
/// place lies behind the triangle, and on the inner side of the three planes through light and
/// edges. A place on a plane counts as one beside it, consistently for all triangles: otherwise an
/// edge between two of them would be met twice, or never.
bool shadows(const Scene& scene, std::uint32_t triangle, const glm::dvec4& light,
             const glm::dvec3& place) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 b = corner(scene, triangle, 1);
    const glm::dvec3 c = corner(scene, triangle, 2);
    return side_of_triangle(a, b, c, place) < 0 && side_of_edge(light, a, b, place) < 0 &&
           side_of_edge(light, b, c, place) < 0 && side_of_edge(light, c, a, place) < 0;
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
