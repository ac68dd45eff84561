#include "raster/volumes/eye_count.h"

#include "raster/volumes/volume.h"
#include "scenes/orientation.h"

#include <cassert>

namespace shadowproof {

namespace {

/// Whether the line from a place to the light (l, w) meets a triangle that faces the light: the
/// place lies behind the triangle, and on the inner side of the three planes through light and
/// edges. A place on a plane counts as one beside it, consistently for all triangles: otherwise an
/// edge between two of them would be met twice, or never. `sign` -1: the opposite of the place,
/// where that is a direction, moved oppositely.
bool shadows(const Scene& scene, std::uint32_t triangle, const glm::dvec4& light,
             const glm::dvec4& place, int sign) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 b = corner(scene, triangle, 1);
    const glm::dvec3 c = corner(scene, triangle, 2);
    return sign * side_of_triangle(a, b, c, place) < 0 &&
           sign * side_of_edge(light, a, b, place) < 0 &&
           sign * side_of_edge(light, b, c, place) < 0 &&
           sign * side_of_edge(light, c, a, place) < 0;
}

std::size_t volumes_around(const Scene& scene, const glm::dvec4& place, int sign) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    // All volumes of a directional light end in one direction, and a tied one is moved off it.
    if (light.w == 0 && place.w == 0) return 0;
    std::size_t count = 0;
    for (const std::uint32_t triangle : triangles_facing_light(scene))
        count += shadows(scene, triangle, light, place, sign) ? 1U : 0U;
    return count;
}

glm::dvec4 end_of_lines(const Camera& camera) {
    assert(camera.is_orthographic());
    return {camera.forward, 0};
}

} // namespace

std::size_t volumes_around_eye(const Scene& scene) {
    const Camera& camera = scene.camera;
    if (camera.is_orthographic()) return volumes_around(scene, end_of_lines(camera), -1);
    return volumes_around(scene, glm::dvec4(camera.eye, 1), 1);
}

std::size_t volumes_at_infinity(const Scene& scene) {
    return volumes_around(scene, end_of_lines(scene.camera), 1);
}

} // namespace shadowproof
