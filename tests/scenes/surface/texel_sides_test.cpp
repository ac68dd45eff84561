// The sides of texels on a surface, and how steep heights are over them.
#include "scenes/surface/texel_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace shadowproof {
namespace {

/// Triangles, and a bump map of 8 x 4 texels whose heights are in units of space.
Scene scene_of(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& places) {
    Scene scene;
    scene.positions = positions;
    for (unsigned i = 0; i < positions.size(); i += 3)
        scene.triangles.emplace_back(i, i + 1, i + 2);
    for (const glm::vec2& at : places)
        scene.surfaces.push_back({.tangent = {1, 0, 0, 1}, .bump_at = at});
    scene.textures.push_back({.name = "relief", .texels = Image<glm::vec4>(8, 4)});
    scene.materials.push_back(
        {.name = "relief", .bump = Bump::height_field, .bump_map = 0, .height_in_space = true});
    scene.meshes.push_back(
        {.name = "relief", .triangle_count = static_cast<std::uint32_t>(scene.triangles.size())});
    return scene;
}

TEST(TexelSides, are_the_ways_from_one_texel_to_the_next) {
    // The map once over 16 x 2 units, its rows along x, down the rows along -y; then leaning.
    const Scene scene =
        scene_of({{0, 0, 0}, {16, 0, 0}, {0, 2, 0}, {0, 0, 0}, {16, 0, 0}, {3, 2, 0}},
                 {{0, 1}, {1, 1}, {0, 0}, {0, 1}, {1, 1}, {0, 0}});
    EXPECT_EQ(texel_sides(scene, 0).along, glm::dvec3(2, 0, 0));
    EXPECT_EQ(texel_sides(scene, 0).down, glm::dvec3(0, -0.5, 0));
    EXPECT_EQ(texel_sides(scene, 1).along, glm::dvec3(2, 0, 0));
    EXPECT_EQ(texel_sides(scene, 1).down, glm::dvec3(-0.75, -0.5, 0));
    EXPECT_EQ(mean_texel_side(scene, scene.materials[0]), 1);
}

TEST(TexelSides, of_a_triangle_without_area_in_the_texture_are_zero_and_so_is_the_gradient) {
    const Scene scene = scene_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0}, {1, 1}, {2, 2}});
    const TexelSides sides = texel_sides(scene, 0);
    EXPECT_EQ(sides.along, glm::dvec3(0));
    EXPECT_EQ(sides.down, glm::dvec3(0));
    EXPECT_EQ(height_gradient(sides, {0, 0, 1}, {1, 1}), glm::dvec3(0));
    EXPECT_EQ(mean_texel_side(scene, scene.materials[0]), 1);
}

TEST(HeightGradient, makes_the_slope_along_each_side_and_lies_across_the_normal) {
    std::mt19937 random(1978);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    for (int i = 0; i < 1000; ++i) {
        const TexelSides sides{vector(), vector()};
        const glm::dvec3 normal = glm::normalize(vector());
        const glm::dvec2 slope(number(random), number(random));
        // What of a side runs along the normal is no way over the surface.
        const auto across = [&](const glm::dvec3& v) { return v - normal * glm::dot(normal, v); };
        const glm::dvec3 gradient = height_gradient(sides, normal, slope);
        const double size = 1 + glm::length(gradient);
        EXPECT_NEAR(glm::dot(gradient, normal), 0, 1e-12 * size);
        EXPECT_NEAR(glm::dot(gradient, across(sides.along)), slope.x, 1e-12 * size);
        EXPECT_NEAR(glm::dot(gradient, across(sides.down)), slope.y, 1e-12 * size);
        const glm::dvec3 reversed = height_gradient(sides, -normal, slope);
        EXPECT_LT(glm::distance(gradient, reversed), 1e-12 * size);
    }
}

/// Blinn's N + h_u (N x P_v) + h_v (P_u x N), v up the picture, on squares of length 1.
TEST(HeightGradient, over_squares_of_one_unit_is_the_slope_itself) {
    const TexelSides squares{{1, 0, 0}, {0, -1, 0}};
    EXPECT_EQ(height_gradient(squares, {0, 0, 1}, {0.25, 0.5}), glm::dvec3(0.25, -0.5, 0));
    const TexelSides stretched{{4, 0, 0}, {0, -1, 0}};
    EXPECT_EQ(height_gradient(stretched, {0, 0, 1}, {0.25, 0.5}), glm::dvec3(0.0625, -0.5, 0));
}

} // namespace
} // namespace shadowproof
