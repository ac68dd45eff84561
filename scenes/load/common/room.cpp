#include "scenes/load/common/room.h"

#include "scenes/load/common/bounding_sphere.h"

#include <glm/geometric.hpp>

namespace shadowproof {

std::optional<FirstHit> first_hit(const Scene& scene, const glm::dvec3& origin,
                                  const glm::dvec3& direction) {
    std::optional<FirstHit> first;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const glm::dvec3 a = corner(scene, t, 0) - origin;
        const glm::dvec3 b = corner(scene, t, 1) - origin;
        const glm::dvec3 c = corner(scene, t, 2) - origin;
        // The direction as a sum of the three corners, times the determinant.
        const double u = glm::dot(direction, glm::cross(b, c));
        const double v = glm::dot(direction, glm::cross(c, a));
        const double w = glm::dot(direction, glm::cross(a, b));
        const bool before = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
        if (!before || u + v + w == 0) continue;
        const double distance = glm::dot(a, glm::cross(b, c)) / (u + v + w);
        if (!(distance > 0) || (first && distance >= first->distance)) continue;
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        first = FirstHit{distance, glm::dot(normal, direction) < 0};
    }
    return first;
}

bool is_room(const Scene& scene) {
    constexpr int enough = 9;
    const glm::dvec3 middle = bounding_sphere(scene).centre;
    int fronts = 0;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const int axes = x * x + y * y + z * z;
                if (axes != 1 && axes != 3) continue;
                const auto hit = first_hit(scene, middle, {x, y, z});
                fronts += hit && hit->front ? 1 : 0;
            }
    return fronts >= enough;
}

} // namespace shadowproof
