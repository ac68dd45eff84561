#include "scenes/bundled/author/shapes.h"
#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/topology.h"
#include "tests/scenes/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>

namespace shadowproof {
namespace {

using test::all_triangles;
using test::cube;
using test::soup;

Scene soup_of(const author::Shape& shape) {
    return soup({shape.vertices.begin(), shape.vertices.end()}, shape.triangles);
}

std::size_t untwinned(const HalfEdgeMesh& mesh) {
    return static_cast<std::size_t>(
        std::count_if(mesh.half_edges.begin(), mesh.half_edges.end(),
                      [](const HalfEdge& h) { return h.twin == no_half_edge; }));
}

/// What the header promises of any mesh; each scene below is held to it.
void expect_well_formed(const HalfEdgeMesh& mesh) {
    const auto end_of = [&](const HalfEdge& h) { return mesh.half_edges[h.next].origin; };
    for (std::uint32_t i = 0; i < mesh.half_edges.size(); ++i) {
        const HalfEdge& h = mesh.half_edges[i];
        const std::uint32_t third = mesh.half_edges[h.next].next;
        EXPECT_EQ(mesh.half_edges[third].next, i);
        EXPECT_EQ(mesh.half_edges[h.next].triangle, h.triangle);
        if (h.twin == no_half_edge) continue;
        EXPECT_EQ(mesh.half_edges[h.twin].twin, i);
        EXPECT_EQ(mesh.half_edges[h.twin].origin, end_of(h));
        EXPECT_EQ(end_of(mesh.half_edges[h.twin]), h.origin);
    }
    std::vector<int> used(mesh.half_edges.size(), 0);
    for (const Edge& edge : mesh.edges) {
        ++used[edge.half_edge];
        if (edge.twin != no_half_edge) ++used[edge.twin];
        EXPECT_EQ(mesh.half_edges[edge.half_edge].twin, edge.twin);
    }
    EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](int n) { return n == 1; }));
    // No edge is left with an untwinned half-edge each way, so that none could be twinned more.
    std::set<std::pair<std::uint32_t, std::uint32_t>> open;
    std::size_t in_rings = 0;
    for (const HalfEdge& h : mesh.half_edges)
        if (h.twin == no_half_edge) open.insert({h.origin, end_of(h)});
    for (const auto& [a, b] : open) EXPECT_FALSE(open.contains({b, a}));
    for (const Ring& ring : boundary_rings(mesh)) {
        in_rings += ring.size();
        EXPECT_GE(ring.size(), 3U);
        EXPECT_EQ(std::set<std::uint32_t>(ring.begin(), ring.end()).size(), ring.size());
        for (std::size_t i = 0; i < ring.size(); ++i)
            EXPECT_TRUE(open.contains({ring[i], ring[(i + 1) % ring.size()]}));
    }
    EXPECT_EQ(in_rings, untwinned(mesh));
}

/// Surplus edges of the scene with its holes filled.
std::size_t surplus_after_filling(Scene scene) {
    const HalfEdgeMesh mesh = connect_all(scene);
    expect_well_formed(mesh);
    test::add_mesh(scene, "filling", fill_holes(mesh));
    return boundary(scene, weld_by_position(scene.positions), all_triangles(scene)).size();
}

TEST(half_edge, a_closed_ball_has_a_twin_everywhere_and_nothing_to_fill) {
    const Scene ball = soup_of(author::ball(1, 3));
    const HalfEdgeMesh mesh = connect_all(ball);
    expect_well_formed(mesh);
    EXPECT_EQ(untwinned(mesh), 0U);
    EXPECT_TRUE(mesh.faults.empty());
    EXPECT_TRUE(fill_holes(mesh).empty());
    // Euler: vertices - edges + triangles = 2.
    EXPECT_EQ(ball.positions.size() - mesh.edges.size() + ball.triangles.size(), 2U);
}

TEST(half_edge, the_order_of_the_triangles_changes_no_edge) {
    const Scene ball = soup_of(author::ball(1, 2));
    std::vector<std::uint32_t> shuffled = all_triangles(ball);
    std::mt19937 random(7);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    const HalfEdgeMesh mesh = connect(ball, weld_by_position(ball.positions), shuffled);
    expect_well_formed(mesh);
    EXPECT_EQ(mesh.edges.size(), connect_all(ball).edges.size());
    EXPECT_EQ(untwinned(mesh), 0U);
}

TEST(half_edge, a_cube_with_a_missing_face_has_one_ring_of_four_and_two_triangles_fill_it) {
    Scene scene = cube();
    test::keep_triangles(scene, 10);
    const HalfEdgeMesh mesh = connect_all(scene);
    EXPECT_EQ(boundary_rings(mesh), (std::vector<Ring>{{5, 4, 6, 7}}));
    EXPECT_EQ(fill_holes(mesh).size(), 2U);
    EXPECT_EQ(surplus_after_filling(scene), 0U);
}

TEST(half_edge, a_moebius_band_has_one_ring_around_both_its_sides) {
    // Six triangles over vertices 0..5; the edge 0-1 joins the ends with a half twist, so that both
    // its triangles run it the same way.
    const Scene band = soup({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 1}, {1, 3, 1}, {0, 2, 2}},
                            {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}, {4, 5, 1}, {5, 0, 1}});
    const HalfEdgeMesh mesh = connect_all(band);
    ASSERT_EQ(mesh.faults.size(), 1U);
    EXPECT_FALSE(mesh.faults[0].non_manifold());
    EXPECT_EQ(words_of(band, mesh.faults[0]), "mesh 'soup': the edge (0, 0, 0) to (1, 0, 0) is run "
                                              "the same way by both its triangles");
    EXPECT_EQ(untwinned(mesh), 8U); // its rim of six, and the twist twice
    EXPECT_EQ(surplus_after_filling(band), 0U);
}

TEST(half_edge, three_triangles_on_one_edge_are_named_and_leave_their_surplus) {
    const Scene fan = soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    const HalfEdgeMesh mesh = connect_all(fan);
    ASSERT_EQ(mesh.faults.size(), 1U);
    EXPECT_TRUE(mesh.faults[0].non_manifold());
    EXPECT_EQ(mesh.faults[0].from_a_to_b, 2U);
    EXPECT_EQ(words_of(fan, mesh.faults[0]),
              "mesh 'soup': the edge (0, 0, 0) to (0, 0, 1) belongs to 3 triangles");
    EXPECT_EQ(untwinned(mesh), 7U); // nine, less the pair on the edge
    EXPECT_EQ(surplus_after_filling(fan), 0U);
}

TEST(half_edge, an_inverted_triangle_contradicts_its_three_neighbours) {
    Scene scene = cube();
    std::swap(scene.triangles[5].y, scene.triangles[5].z);
    const HalfEdgeMesh mesh = connect_all(scene);
    EXPECT_EQ(mesh.faults.size(), 3U);
    for (const EdgeFault& fault : mesh.faults) EXPECT_FALSE(fault.non_manifold());
    EXPECT_EQ(untwinned(mesh), 6U);
    EXPECT_EQ(boundary_rings(mesh).size(), 2U); // the triangle's own, and the hole it ought to fill
    EXPECT_EQ(surplus_after_filling(scene), 0U);
}

TEST(half_edge, rings_that_touch_at_a_vertex_are_two) {
    // A sheet of 4 by 4 squares without two that share the corner (2, 2) only.
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    for (unsigned i = 0; i < 5; ++i)
        for (unsigned k = 0; k < 5; ++k) positions.emplace_back(i, k, 0);
    for (unsigned i = 0; i < 4; ++i)
        for (unsigned k = 0; k < 4; ++k) {
            if ((i == 1 && k == 1) || (i == 2 && k == 2)) continue;
            const unsigned corner = 5 * i + k;
            triangles.emplace_back(corner, corner + 5, corner + 6);
            triangles.emplace_back(corner, corner + 6, corner + 1);
        }
    const Scene sheet = soup(positions, triangles);
    std::vector<Ring> rings = boundary_rings(connect_all(sheet));
    ASSERT_EQ(rings.size(), 3U); // and the sheet's own
    std::sort(rings.begin(), rings.end(),
              [](const Ring& left, const Ring& right) { return left.size() < right.size(); });
    EXPECT_EQ(rings[0].size(), 4U);
    EXPECT_EQ(rings[1].size(), 4U);
    EXPECT_EQ(rings[2].size(), 16U);
    EXPECT_EQ(surplus_after_filling(sheet), 0U);
}

TEST(half_edge, a_triangle_with_two_equal_corners_takes_no_part) {
    Scene scene = cube();
    scene.positions.push_back(scene.positions[0]); // welds to vertex 0
    scene.triangles.emplace_back(0, 8, 1);
    const HalfEdgeMesh mesh = connect_all(scene);
    EXPECT_EQ(mesh.half_edges.size(), 36U);
    EXPECT_EQ(untwinned(mesh), 0U);
}

TEST(half_edge, of_no_triangles_there_is_nothing) {
    const HalfEdgeMesh mesh = connect(cube(), {}, {});
    EXPECT_TRUE(mesh.half_edges.empty() && mesh.edges.empty() && boundary_rings(mesh).empty());
}

TEST(half_edge, any_soup_is_closed_by_its_filling_and_few_are_without) {
    int open = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::size_t vertices = 4 + random() % 20;
        std::vector<glm::vec3> positions;
        for (std::size_t i = 0; i < vertices; ++i) // on a small grid, so that some weld
            positions.emplace_back(random() % 4, random() % 3, random() % 2);
        std::vector<glm::uvec3> triangles;
        const std::size_t count = 1 + random() % 60;
        for (std::size_t i = 0; i < count; ++i)
            triangles.emplace_back(random() % vertices, random() % vertices, random() % vertices);
        const Scene scene = soup(positions, triangles);
        open += !boundary(scene, weld_by_position(positions), all_triangles(scene)).empty();
        EXPECT_EQ(surplus_after_filling(scene), 0U);
    }
    EXPECT_GT(open, 250);
}

TEST(half_edge, what_has_no_twin_is_the_surplus) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::vector<glm::vec3> positions;
        for (unsigned i = 0; i < 9; ++i) positions.emplace_back(i, i * i % 7, 0);
        std::vector<glm::uvec3> triangles;
        for (unsigned i = 0; i < 40; ++i)
            triangles.emplace_back(random() % 9, random() % 9, random() % 9);
        const Scene scene = soup(positions, triangles);
        std::size_t surplus = 0;
        for (const SurplusEdge& edge :
             boundary(scene, weld_by_position(positions), all_triangles(scene)))
            surplus += static_cast<std::size_t>(edge.surplus);
        EXPECT_EQ(untwinned(connect_all(scene)), surplus);
    }
}

TEST(half_edge, a_million_triangles_are_connected_within_seconds) {
    // Measured: 0.4 s with the making of the torus; the bound leaves room for a debug build under
    // a sanitizer, and none for a quadratic step.
    const Scene torus = soup_of(author::torus(2, 1, 1000, 500));
    ASSERT_EQ(torus.triangles.size(), 1000000U);
    const auto start = std::chrono::steady_clock::now();
    const HalfEdgeMesh mesh = connect_all(torus);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    RecordProperty("seconds", std::to_string(seconds.count()));
    EXPECT_EQ(untwinned(mesh), 0U);
    EXPECT_EQ(mesh.edges.size(), 1500000U);
    EXPECT_LT(seconds.count(), 20);
}

} // namespace
} // namespace shadowproof
