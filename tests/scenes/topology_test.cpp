#include "scenes/topology.h"

#include <gtest/gtest.h>

#include <numeric>

namespace shadowproof {
namespace {

Scene soup(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles) {
    Scene scene;
    scene.positions = std::move(positions);
    scene.triangles = std::move(triangles);
    scene.meshes = {{"soup", 0, static_cast<std::uint32_t>(scene.triangles.size()), 0}};
    scene.materials = {{"plain", false}};
    scene.lights.emplace_back();
    return scene;
}

/// Corner i at (i & 1, i >> 1 & 1, i >> 2); the last two triangles are the top, z = 1.
Scene cube() {
    std::vector<glm::vec3> corners;
    for (unsigned i = 0; i < 8; ++i) corners.emplace_back(i & 1U, i >> 1U & 1U, i >> 2U);
    return soup(corners, {{0, 2, 3},
                          {0, 3, 1},
                          {0, 1, 5},
                          {0, 5, 4},
                          {1, 3, 7},
                          {1, 7, 5},
                          {3, 2, 6},
                          {3, 6, 7},
                          {2, 0, 4},
                          {2, 4, 6},
                          {4, 5, 7},
                          {4, 7, 6}});
}

std::vector<SurplusEdge> whole_boundary(const Scene& scene) {
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return boundary(scene, weld_by_position(scene.positions), all);
}

TEST(weld, equal_positions_become_the_first_and_minus_zero_is_zero) {
    const std::vector<glm::vec3> positions{{1, 0, 0}, {0, 0, 0}, {1, -0.F, 0}, {-0.F, 0, -0.F}};
    EXPECT_EQ(weld_by_position(positions), (std::vector<std::uint32_t>{0, 1, 0, 1}));
}

TEST(topology, a_cube_is_closed) {
    const Scene scene = cube();
    EXPECT_TRUE(whole_boundary(scene).empty());
    const CasterReport report = inspect_casters(scene).at(0);
    EXPECT_TRUE(report.closed());
    EXPECT_EQ(report.rings, 0U);
    EXPECT_EQ(report.non_manifold_edges, 0U);
}

TEST(topology, a_cube_stays_closed_when_every_triangle_has_its_own_vertices) {
    const Scene shared = cube();
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    for (const glm::uvec3& triangle : shared.triangles) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (int k = 0; k < 3; ++k) positions.push_back(shared.positions[triangle[k]]);
        triangles.emplace_back(first, first + 1, first + 2);
    }
    EXPECT_TRUE(inspect_casters(soup(positions, triangles)).at(0).closed());
}

TEST(topology, a_cube_without_its_top_has_one_ring_of_four) {
    Scene scene = cube();
    scene.triangles.resize(10);
    scene.meshes[0].triangle_count = 10;
    const CasterReport report = inspect_casters(scene).at(0);
    EXPECT_EQ(report.boundary_edges, 4U);
    EXPECT_EQ(report.rings, 1U);
    const std::vector<SurplusEdge> edges = whole_boundary(scene);
    ASSERT_EQ(edges.size(), 4U); // the sides run the top's ring backwards: 4 <- 5 <- 7 <- 6 <- 4
    EXPECT_EQ(edges[0].a, 4U);
    EXPECT_EQ(edges[0].b, 6U);
    EXPECT_EQ(edges[0].surplus, 1);
}

TEST(topology, cubes_without_top_and_bottom_have_two_rings) {
    Scene scene = cube();
    scene.triangles = {scene.triangles.begin() + 2, scene.triangles.begin() + 10};
    scene.meshes[0].triangle_count = 8;
    EXPECT_EQ(inspect_casters(scene).at(0).rings, 2U);
}

TEST(topology, three_triangles_on_one_edge_are_not_manifold) {
    const Scene fan = soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                           {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
    const CasterReport report = inspect_casters(fan).at(0);
    EXPECT_EQ(report.non_manifold_edges, 1U);
    const std::vector<SurplusEdge> edges = whole_boundary(fan);
    EXPECT_EQ(edges.front().surplus, 3);
}

TEST(topology, a_moebius_strip_has_a_surplus_where_its_winding_breaks) {
    // A strip of 6 triangles over vertices 0..5, its ends joined with a half twist.
    const Scene strip = soup({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 1}, {1, 3, 1}, {0, 2, 2}},
                             {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}, {4, 5, 1}, {5, 0, 1}});
    EXPECT_FALSE(inspect_casters(strip).at(0).closed());
    int most = 0;
    for (const SurplusEdge& edge : whole_boundary(strip)) most = std::max(most, edge.surplus);
    EXPECT_EQ(most, 2); // one edge is run the same way by both its triangles
}

TEST(topology, a_triangle_without_area_takes_no_part) {
    Scene scene = cube();
    scene.triangles.emplace_back(0, 0, 1);
    scene.meshes[0].triangle_count = 13;
    EXPECT_TRUE(inspect_casters(scene).at(0).closed());
}

} // namespace
} // namespace shadowproof
