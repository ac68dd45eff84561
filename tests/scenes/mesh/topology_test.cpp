#include "scenes/mesh/topology.h"
#include "tests/scenes/soups.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof {
namespace {

using test::cube;
using test::soup;

std::vector<SurplusEdge> whole_boundary(const Scene& scene) {
    return boundary(scene, weld_by_position(scene.positions), test::all_triangles(scene));
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
    test::keep_triangles(scene, 10);
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

std::string words_of_first(const Scene& scene) {
    return words_of(scene, inspect_casters(scene).at(0));
}

TEST(topology, a_closed_caster_wound_outwards_is_not_worth_a_word) {
    EXPECT_EQ(words_of_first(cube()), "");
}

TEST(topology, an_open_caster_is_named_with_its_edges_and_rings) {
    Scene scene = cube();
    test::keep_triangles(scene, 10);
    scene.meshes[0].name = "lid";
    EXPECT_EQ(words_of_first(scene), "caster 'lid' is open: 4 boundary edges in 1 ring; techniques "
                                     "that need closed volumes may fail (open_mesh)");
}

TEST(topology, a_cube_inside_out_is_inverted_and_a_cube_is_not) {
    Scene scene = cube();
    EXPECT_FALSE(inspect_casters(scene).at(0).inverted);
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.x, triangle.y);
    EXPECT_TRUE(inspect_casters(scene).at(0).inverted);
    EXPECT_EQ(words_of_first(scene), "caster 'soup' is wound inside out: the volume it encloses is "
                                     "negative; techniques that need closed volumes may fail "
                                     "(open_mesh)");
}

TEST(topology, an_open_caster_is_never_called_inverted) {
    Scene scene = cube();
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.x, triangle.y);
    test::keep_triangles(scene, 11);
    EXPECT_FALSE(inspect_casters(scene).at(0).inverted);
}

TEST(topology, two_sides_of_one_sheet_enclose_nothing_and_are_not_inverted) {
    const Scene sheet = soup({{0, 0, 0}, {1, 0, 0.3F}, {0, 1, 0.7F}}, {{0, 1, 2}, {2, 1, 0}});
    EXPECT_TRUE(inspect_casters(sheet).at(0).closed());
    EXPECT_FALSE(inspect_casters(sheet).at(0).inverted);
}

TEST(topology, far_from_the_origin_an_inverted_cube_is_still_told_from_a_cube) {
    for (const bool flipped : {false, true}) {
        Scene scene = cube();
        for (glm::vec3& position : scene.positions) position += glm::vec3(8e6F, -8e6F, 8e6F);
        if (flipped)
            for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.x, triangle.y);
        EXPECT_EQ(inspect_casters(scene).at(0).inverted, flipped);
    }
}

TEST(topology, a_flipped_triangle_is_reported_as_edges_run_the_same_way) {
    Scene scene = cube();
    std::swap(scene.triangles[5].y, scene.triangles[5].z); // corners 1, 7, 5
    const CasterReport report = inspect_casters(scene).at(0);
    EXPECT_EQ(report.inconsistent_edges, 3U);
    EXPECT_EQ(report.non_manifold_edges, 0U);
    EXPECT_EQ(
        words_of_first(scene),
        "caster 'soup' is open: 3 boundary edges in 2 rings, 3 edges run the same way by both "
        "triangles (first (1, 0, 0) to (1, 0, 1)); techniques that need closed volumes may "
        "fail (open_mesh)");
}

TEST(topology, cubes_that_share_an_edge_are_closed_and_not_two_manifold) {
    Scene scene = cube();
    const auto count = static_cast<std::uint32_t>(scene.positions.size());
    for (std::uint32_t i = 0; i < count; ++i)
        scene.positions.push_back(scene.positions[i] + glm::vec3(1, 1, 0));
    for (std::uint32_t i = 0; i < 12; ++i)
        scene.triangles.push_back(scene.triangles[i] + glm::uvec3(count));
    scene.meshes[0].triangle_count = 24;
    const CasterReport report = inspect_casters(scene).at(0);
    EXPECT_TRUE(report.closed());
    EXPECT_EQ(report.non_manifold_edges, 1U);
    EXPECT_EQ(words_of_first(scene),
              "caster 'soup' is not two-manifold: 1 edge of more than two triangles (first "
              "(1, 1, 0) to (1, 1, 1)); it encloses a volume all the same");
}

TEST(topology, a_body_in_two_materials_is_closed_by_its_other_part_and_not_by_less) {
    Scene scene = cube();
    const std::vector<glm::uvec3> top(scene.triangles.end() - 2, scene.triangles.end());
    test::keep_triangles(scene, 10);
    test::add_mesh(scene, "top", top);
    for (const CasterReport& report : inspect_casters(scene)) {
        EXPECT_FALSE(report.closed());
        EXPECT_TRUE(report.closed_by_others);
        EXPECT_EQ(words_of(scene, report), "");
    }
    scene.triangles.pop_back(); // half of the top
    --scene.meshes[1].triangle_count;
    for (const CasterReport& report : inspect_casters(scene)) {
        EXPECT_FALSE(report.encloses_volume());
        EXPECT_NE(words_of(scene, report), "");
    }
}

} // namespace
} // namespace shadowproof
