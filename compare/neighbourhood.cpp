#include "compare/neighbourhood.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

Neighbourhood neighbourhood(const Camera& camera, int x, int y, const BandRadius& radius) {
    constexpr std::array<double, 5> steps{0, -1, 1, -0.5, 0.5};
    Neighbourhood around;
    const auto ray = [&](double right, double down) {
        return ray_direction(camera, x + 0.5 + right, y + 0.5 + down);
    };
    const auto add = [&](double reach) {
        for (std::size_t i = 1; i < steps.size() * steps.size(); ++i)
            around.rays.push_back(
                ray(reach * steps[i % steps.size()], reach * steps[i / steps.size()]));
    };
    around.rays.push_back(ray(0, 0));
    if (radius.surface > 0) add(radius.surface);
    if (radius.nearest > radius.surface) add(radius.nearest);
    const double reach = std::max(radius.surface, radius.nearest);
    around.reach = reach;
    around.corners = {ray(-reach, -reach), ray(reach, -reach), ray(reach, reach),
                      ray(-reach, reach)};
    return around;
}

double spread(const Neighbourhood& around) {
    double largest = 0;
    for (const glm::dvec3& corner : around.corners) {
        const glm::dvec3 apart = glm::abs(corner - around.rays.front());
        largest = std::max({largest, apart.x, apart.y, apart.z});
    }
    return largest;
}

bool may_cover(const Scene& scene, std::uint32_t triangle, const glm::dvec3& direction,
               double freedom) {
    const glm::dvec3 a = corner(scene, triangle, 0) - scene.camera.eye;
    const glm::dvec3 b = corner(scene, triangle, 1) - scene.camera.eye;
    const glm::dvec3 c = corner(scene, triangle, 2) - scene.camera.eye;
    const double facing = glm::dot(a, glm::cross(b, c)) < 0 ? -1 : 1;
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 plane = facing * glm::cross(from, to);
        const glm::dvec3 size = glm::abs(plane);
        return glm::dot(direction, plane) >= -freedom * (size.x + size.y + size.z);
    };
    return inside(a, b) && inside(b, c) && inside(c, a);
}

namespace {

/// Triangles with two corners in common meet without a gap wherever those are moved to.
bool share_an_edge(const Scene& scene, std::uint32_t one, std::uint32_t other) {
    int shared = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            shared += corner(scene, one, i) == corner(scene, other, k) ? 1 : 0;
    return shared >= 2;
}

} // namespace

bool may_gape(const Scene& scene, std::vector<std::uint32_t> triangles) {
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    if (triangles.empty()) return false;
    std::vector<std::uint32_t> connected{triangles.back()};
    triangles.pop_back();
    for (std::size_t i = 0; i < connected.size(); ++i) {
        const auto apart =
            std::partition(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
                return !share_an_edge(scene, connected[i], triangle);
            });
        connected.insert(connected.end(), apart, triangles.end());
        triangles.erase(apart, triangles.end());
    }
    return !triangles.empty();
}

} // namespace shadowproof
