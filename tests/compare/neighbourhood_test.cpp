#include "compare/neighbourhood.h"
#include "scenes/camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>
#include <set>

namespace shadowproof {
namespace {

constexpr double reach = 0.01; ///< pixels

Neighbourhood around_a_pixel() {
    Camera camera;
    camera.width = camera.height = 64;
    return neighbourhood(camera, 40, 20, {.surface = reach, .nearest = 0});
}

/// A ray through a place of the neighbourhood whose corners are (-1, -1) to (1, 1).
glm::dvec3 through(const Neighbourhood& around, const glm::dvec2& place) {
    return around.rays.front() + 0.5 * (place.x * (around.corners[1] - around.corners[0]) +
                                        place.y * (around.corners[3] - around.corners[0]));
}

/// The plane through the eye and two such rays.
glm::dvec3 plane_through(const Neighbourhood& around, const glm::dvec2& a, const glm::dvec2& b) {
    return glm::cross(through(around, a), through(around, b));
}

std::vector<bool> part_of(const std::vector<glm::dvec3>& planes, const glm::dvec3& ray) {
    std::vector<bool> part;
    for (const glm::dvec3& plane : planes) part.push_back(glm::dot(plane, ray) < 0);
    return part;
}

TEST(RaysBetween, lie_in_every_part_that_planes_divide_the_neighbourhood_into) {
    const Neighbourhood around = around_a_pixel();
    std::mt19937 random(20260402);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const auto place = [&] { return glm::dvec2(anywhere(random), anywhere(random)); };
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<glm::dvec3> planes;
        for (int i = 0; i < 1 + trial % 7; ++i)
            planes.push_back(plane_through(around, place(), place()));
        std::set<std::vector<bool>> found;
        for (const glm::dvec3& ray : rays_between(around, planes)) {
            EXPECT_LE(glm::length(ray - around.rays.front()),
                      glm::length(around.corners[0] - around.rays.front()));
            EXPECT_TRUE(found.insert(part_of(planes, ray)).second) << "the same part twice";
        }
        for (int i = 0; i < 10000; ++i)
            EXPECT_TRUE(found.contains(part_of(planes, through(around, place()))))
                << "trial " << trial;
    }
}

TEST(RaysBetween, lie_in_a_part_a_millionth_as_wide_as_the_neighbourhood) {
    const Neighbourhood around = around_a_pixel();
    const std::vector<glm::dvec3> planes{plane_through(around, {0.3, -1}, {0.2, 1}),
                                         plane_through(around, {0.300001, -1}, {0.200001, 1})};
    std::set<std::vector<bool>> found;
    for (const glm::dvec3& ray : rays_between(around, planes)) found.insert(part_of(planes, ray));
    EXPECT_EQ(found.size(), 3U);
}

TEST(RaysBetween, are_none_where_no_plane_passes) {
    const Neighbourhood around = around_a_pixel();
    EXPECT_TRUE(rays_between(around, {}).empty());
    EXPECT_TRUE(rays_between(around, {plane_through(around, {3, -1}, {3, 1})}).empty());
}

} // namespace
} // namespace shadowproof
