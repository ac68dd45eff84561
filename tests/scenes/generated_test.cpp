#include "scenes/generated.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

namespace shadowproof {
namespace {

/// How often each directed edge of the first triangles occurs.
std::map<std::pair<glm::uint, glm::uint>, int> edges_of(const Scene& scene, std::size_t triangles) {
    std::map<std::pair<glm::uint, glm::uint>, int> edges;
    for (std::size_t i = 0; i < triangles; ++i)
        for (int k = 0; k < 3; ++k)
            ++edges[{scene.triangles[i][k], scene.triangles[i][(k + 1) % 3]}];
    return edges;
}

TEST(StackedScene, is_of_closed_plates_wound_outwards) {
    for (const int plates : {1, 2, 64}) {
        const Scene scene = stacked_scene(plates, 8, 8);
        const auto casters = static_cast<std::size_t>(12 * plates);
        ASSERT_EQ(scene.triangles.size(), casters + 2) << "the floor has two";
        const auto edges = edges_of(scene, casters);
        for (const auto& [edge, times] : edges) {
            EXPECT_EQ(times, 1);
            EXPECT_TRUE(edges.contains({edge.second, edge.first}));
        }
        double sixfold_volume = 0;
        for (std::uint32_t i = 0; i < casters; ++i)
            sixfold_volume +=
                glm::dot(corner(scene, i, 0), glm::cross(corner(scene, i, 1), corner(scene, i, 2)));
        // Each is 2.4 wide and deep, and half as high as its share of 1.5.
        EXPECT_NEAR(sixfold_volume / 6, 2.4 * 2.4 * 0.75, 1e-3);
    }
}

TEST(DenseScene, has_about_as_many_triangles_as_asked_for) {
    for (const int triangles : {1'000, 64'000})
        EXPECT_NEAR(static_cast<double>(dense_scene(triangles, 8, 8).triangles.size()), triangles,
                    0.05 * triangles);
}

TEST(PartedScene, is_of_closed_balls_with_about_as_many_triangles_together) {
    for (const int balls : {1, 4, 16, 64, 256, 1024}) {
        const Scene scene = parted_scene(balls, 8, 8);
        const std::size_t casters = scene.triangles.size() - 2; // the floor has two
        EXPECT_NEAR(static_cast<double>(casters), 57'000, 9'000) << balls;
        const auto edges = edges_of(scene, casters);
        for (const auto& [edge, times] : edges) {
            ASSERT_EQ(times, 1);
            ASSERT_TRUE(edges.contains({edge.second, edge.first}));
        }
        for (const glm::vec3& corner : scene.positions) EXPECT_GE(corner.y, -1.3F);
    }
}

TEST(LitScene, has_so_many_lights_in_a_circle_above_it) {
    const Scene scene = lit_scene(64, 8, 8);
    ASSERT_EQ(scene.lights.size(), 64U);
    std::set<std::pair<double, double>> places;
    for (const Light& light : scene.lights) {
        EXPECT_NEAR(glm::length(light.position - glm::dvec3(0, 5.3, -6.5)), 4.1, 1e-9);
        places.emplace(light.position.x, light.position.z);
    }
    EXPECT_EQ(places.size(), 64U);
}

} // namespace
} // namespace shadowproof
