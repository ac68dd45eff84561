#include "scenes/surface/tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <random>

namespace shadowproof {
namespace {

using Corners = std::vector<TexturedCorner>;

/// A triangle in z = 0, seen from +z, with texture coordinates as given.
void add(Corners& corners, std::array<glm::vec2, 3> places, std::array<glm::vec2, 3> at) {
    for (std::size_t k = 0; k < 3; ++k)
        corners.push_back({glm::vec3(places[k], 0), {0, 0, 1}, at[k]});
}

/// glTF's v grows down the picture: (x, y) of the plane upright at (x, 1 - y).
Corners upright_square() {
    Corners corners;
    add(corners, {{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 1}, {1, 1}, {1, 0}}});
    add(corners, {{{0, 0}, {1, 1}, {0, 1}}}, {{{0, 1}, {1, 0}, {0, 0}}});
    return corners;
}

void expect_near(const glm::vec4& found, const glm::vec4& expected) {
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(found[k], expected[k], 1e-6F); // a rounding to float
}

TEST(tangents, of_an_upright_picture_point_to_its_right_and_bitangents_up) {
    for (const glm::vec4& tangent : make_tangents(upright_square())) {
        expect_near(tangent, {1, 0, 0, 1});
        const glm::vec3 up = tangent.w * glm::cross(glm::vec3(0, 0, 1), glm::vec3(tangent));
        EXPECT_NEAR(up.y, 1, 1e-6F);
    }
}

TEST(tangents, of_a_mirrored_picture_are_of_the_other_hand) {
    Corners corners = upright_square();
    for (TexturedCorner& corner : corners) corner.at.x = 1 - corner.at.x;
    for (const glm::vec4& tangent : make_tangents(corners)) expect_near(tangent, {-1, 0, 0, -1});
}

TEST(tangents, part_where_two_mirrored_charts_meet_although_the_vertices_are_the_same) {
    // x in [0, 1] and its mirror image; at x = 0 position, normal and coordinates are shared.
    Corners corners = upright_square();
    const Corners right = corners;
    for (std::size_t i = 0; i < right.size(); i += 3)
        for (const std::size_t k : {0U, 2U, 1U}) { // counter-clockwise again
            TexturedCorner corner = right[i + k];
            corner.position.x = -corner.position.x;
            corners.push_back(corner);
        }
    const std::vector<glm::vec4> tangents = make_tangents(corners);
    for (std::size_t i = 0; i < 6; ++i) {
        expect_near(tangents[i], {1, 0, 0, 1});
        expect_near(tangents[i + 6], {-1, 0, 0, -1});
    }
}

TEST(tangents, are_weighted_by_the_angle_and_not_by_the_number_or_the_area_of_triangles) {
    // Around the origin: 90 degrees with the tangent +x, and 30 degrees more with one along
    // -(c, s), as the texture coordinates (-1, 0) of (c, s) make it.
    const float c = std::cos(glm::radians(120.0F));
    const float s = std::sin(glm::radians(120.0F));
    Corners corners;
    add(corners, {{{0, 0}, {100, 0}, {0, 1}}}, {{{0, 0}, {100, 0}, {0, -1}}});
    add(corners, {{{0, 0}, {0, 1}, {c, s}}}, {{{0, 0}, {0, -1}, {-1, 0}}});
    const glm::vec2 sum = glm::normalize(90.0F * glm::vec2(1, 0) + 30.0F * glm::vec2(-c, -s));
    for (const std::size_t corner : {0U, 3U})
        expect_near(make_tangents(corners)[corner], glm::vec4(sum, 0, 1));
    // Mirrored, with (1, 0), the second has a tangent of its own.
    corners[5].at = {1, 0};
    expect_near(make_tangents(corners)[0], {1, 0, 0, 1});
    expect_near(make_tangents(corners)[3], {c, s, 0, -1});
}

TEST(tangents, do_not_cross_an_edge_where_normals_differ) {
    Corners corners = upright_square();
    for (std::size_t i = 3; i < 6; ++i) {
        corners[i].normal = {0, 0.6F, 0.8F};
        corners[i].at = {corners[i].at.y, -corners[i].at.x}; // turned by a right angle
    }
    const std::vector<glm::vec4> tangents = make_tangents(corners);
    for (std::size_t i = 0; i < 3; ++i) expect_near(tangents[i], {1, 0, 0, 1});
    for (std::size_t i = 3; i < 6; ++i)
        EXPECT_NEAR(glm::dot(glm::vec3(tangents[i]), corners[i].normal), 0, 1e-6F);
}

TEST(tangents, where_a_triangle_has_no_area_are_those_of_its_neighbours_or_any) {
    Corners corners = upright_square();
    add(corners, {{{0, 0}, {1, 0}, {0, -1}}}, {{{0, 1}, {1, 1}, {0.5F, 1}}}); // none in the texture
    add(corners, {{{5, 5}, {5, 5}, {5, 5}}}, {{{0, 0}, {1, 0}, {0, 1}}});     // none in space
    const std::vector<glm::vec4> tangents = make_tangents(corners);
    expect_near(tangents[6], {1, 0, 0, 1});
    expect_near(tangents[7], {1, 0, 0, 1});
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::vec3(tangents[i])), 1, 1e-6F);
        EXPECT_EQ(std::abs(tangents[i].w), 1);
    }
}

/// A vertex of a grid whose picture is mirrored at x = 1.
TexturedCorner grid_corner(int column, int row) {
    const auto x = static_cast<float>(column);
    const auto y = static_cast<float>(row);
    TexturedCorner corner;
    corner.position = {x + 0.2F * std::sin(3 * x + 5 * y), y + 0.15F * std::cos(2 * x - y),
                       0.3F * std::sin(x + 2 * y)};
    corner.normal =
        glm::normalize(glm::vec3(0.3F * std::sin(4 * x + y), 0.25F * std::cos(x - 3 * y), 1));
    corner.at = {std::abs(x - 1) * (1 + 0.1F * std::sin(7 * x + y)),
                 0.1F * std::cos(x + 6 * y) - y};
    return corner;
}

TEST(tangents, are_those_that_the_published_code_of_mikktspace_finds) {
    Corners corners;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            for (const auto& corner :
                 {grid_corner(x, y), grid_corner(x + 1, y), grid_corner(x + 1, y + 1),
                  grid_corner(x, y), grid_corner(x + 1, y + 1), grid_corner(x, y + 1)})
                corners.push_back(corner);
    struct Known {
        std::size_t corner;
        glm::vec4 tangent;
    };
    // By mikktspace 1.1.1 of npm, w turned round as it says that glTF needs it.
    const Known known[]{
        {0, {-0.993102, 0.113753, -0.028438, -1}},   {1, {-0.937980, 0.244328, -0.245962, -1}},
        {2, {-0.957688, 0.115884, -0.263449, -1}},   {5, {-0.971260, -0.059676, 0.230417, -1}},
        {6, {0.940115, -0.236566, 0.245399, 1}},     {7, {0.949896, -0.108303, -0.293204, 1}},
        {8, {0.924638, -0.375500, -0.063597, 1}},    {11, {0.826733, -0.532184, 0.182466, 1}},
        {14, {-0.994463, -0.069983, -0.078398, -1}}, {17, {-0.948521, -0.128329, 0.289551, -1}},
        {20, {0.913730, -0.397509, 0.084169, 1}},    {23, {0.939565, -0.326843, 0.101937, 1}}};
    const std::vector<glm::vec4> found = make_tangents(corners);
    for (const auto& [corner, tangent] : known) {
        SCOPED_TRACE(corner);
        expect_near(found[corner], tangent);
    }
}

/// A bumpy square of 2 n^2 triangles, its picture mirrored in the middle.
Corners random_patch(std::mt19937& random) {
    constexpr int n = 6;
    std::uniform_real_distribution<float> jitter(-0.2F, 0.2F);
    std::array<std::array<TexturedCorner, n + 1>, n + 1> grid;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            TexturedCorner& corner = grid[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
            const glm::vec2 place(x, y);
            corner.position = {place.x + jitter(random), place.y + jitter(random), jitter(random)};
            corner.normal = glm::normalize(glm::vec3(jitter(random), jitter(random), 1));
            corner.at = {std::abs(place.x - 3) + (x == 3 ? 0 : jitter(random)),
                         jitter(random) - place.y};
        }
    Corners corners;
    for (std::size_t y = 0; y < n; ++y)
        for (std::size_t x = 0; x < n; ++x) {
            for (const auto& corner : {grid[y][x], grid[y][x + 1], grid[y + 1][x + 1]})
                corners.push_back(corner);
            for (const auto& corner : {grid[y][x], grid[y + 1][x + 1], grid[y + 1][x]})
                corners.push_back(corner);
        }
    return corners;
}

TEST(tangents, do_not_depend_on_the_order_of_triangles_nor_on_which_corner_is_first) {
    constexpr std::uint32_t seed = 20261121;
    std::mt19937 random(seed);
    const Corners corners = random_patch(random);
    const std::vector<glm::vec4> expected = make_tangents(corners);
    std::vector<std::size_t> order(corners.size() / 3);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    Corners shuffled;
    for (const std::size_t triangle : order)
        for (std::size_t k = 0; k < 3; ++k)
            shuffled.push_back(corners[3 * triangle + (k + triangle) % 3]);
    const std::vector<glm::vec4> found = make_tangents(shuffled);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            expect_near(found[3 * i + k], expected[3 * order[i] + (k + order[i]) % 3]);
}

} // namespace
} // namespace shadowproof
