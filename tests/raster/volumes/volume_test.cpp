#include "raster/volumes/volume.h"
#include "scenes/mesh/topology.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace shadowproof::tests {
namespace {

/// Directed edges of the volume's triangles that no opposite edge balances. Corners are welded by
/// position; those at infinity are their own.
std::size_t unbalanced_edges(const Scene& scene, const ShadowVolume& volume) {
    const std::vector<std::uint32_t> welded = weld_by_position(scene.positions);
    const auto n = static_cast<std::uint32_t>(scene.positions.size());
    const auto weld = [&](std::uint32_t i) { return i < n ? welded[i] : welded[i - n] + n; };
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> surplus;
    std::vector<glm::uvec3> flipped_back = volume.flipped_sides;
    for (glm::uvec3& triangle : flipped_back) std::swap(triangle.x, triangle.y);
    for (const std::vector<glm::uvec3>* part :
         {&volume.light_cap, &volume.sides, &volume.dark_cap, &std::as_const(flipped_back)}) {
        for (const glm::uvec3& triangle : *part) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = weld(triangle[k]);
                const std::uint32_t b = weld(triangle[(k + 1) % 3]);
                if (a < b) ++surplus[{a, b}];
                if (b < a) --surplus[{b, a}];
            }
        }
    }
    std::size_t unbalanced = 0;
    for (const auto& [edge, count] : surplus)
        if (count != 0) ++unbalanced;
    return unbalanced;
}

ShadowVolume extrude(const Scene& scene) {
    return by_silhouettes(scene)();
}

Scene random_soup(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> lattice(-2, 2); // few places: many shared corners and edges
    Scene scene = empty_scene();
    scene.lights[0].position = {0.3, 0.1, 7.7};
    for (int i = 0; i < 60; ++i) {
        glm::uvec3 corners;
        for (int k = 0; k < 3; ++k) {
            corners[k] = static_cast<std::uint32_t>(scene.positions.size());
            scene.positions.emplace_back(lattice(random), lattice(random), lattice(random));
        }
        scene.triangles.push_back(corners);
    }
    scene.meshes.push_back({.name = "soup", .triangle_count = 60});
    return scene;
}

TEST(Volume, of_a_box_below_the_light_is_its_top_and_four_sides) {
    Scene scene = empty_scene();
    scene.lights[0].position = {0, 6, 0};
    add_box(scene, {-1, 1, -1}, {1, 2, 1});
    const ShadowVolume volume = extrude(scene);
    EXPECT_EQ(volume.light_cap.size(), 2U);
    EXPECT_EQ(volume.sides.size() + volume.flipped_sides.size(), 8U);
    EXPECT_EQ(volume.dark_cap.size(), 2U);
    for (const glm::uvec3& triangle : volume.light_cap)
        for (int k = 0; k < 3; ++k) EXPECT_EQ(scene.positions[triangle[k]].y, 2.0F);
}

TEST(Volume, of_any_soup_has_no_crack) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const Scene scene = random_soup(seed);
        EXPECT_EQ(unbalanced_edges(scene, extrude(scene)), 0U) << "seed " << seed;
    }
}

TEST(Volume, without_a_side_or_a_cap_has_a_crack) {
    Scene scene = empty_scene();
    scene.lights[0].position = {3, 6, 1};
    add_box(scene, {-1, 1, -1}, {1, 2, 1});
    const ShadowVolume whole = extrude(scene);
    EXPECT_EQ(unbalanced_edges(scene, whole), 0U);
    ShadowVolume broken = whole;
    broken.sides.pop_back();
    EXPECT_EQ(unbalanced_edges(scene, broken), 3U);
    broken = whole;
    broken.dark_cap.clear();
    EXPECT_GT(unbalanced_edges(scene, broken), 0U);
    broken = whole;
    broken.light_cap.pop_back();
    EXPECT_EQ(unbalanced_edges(scene, broken), 3U);
}

TEST(Volume, of_two_equal_triangles_has_each_side_twice) {
    Scene scene = empty_scene();
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.triangles = {{0, 1, 2}, {3, 4, 5}};
    scene.meshes.push_back({.name = "pair", .triangle_count = 2});
    const ShadowVolume volume = extrude(scene);
    EXPECT_EQ(volume.light_cap.size(), 2U);
    EXPECT_EQ(volume.sides.size() + volume.flipped_sides.size(), 12U);
    EXPECT_EQ(unbalanced_edges(scene, volume), 0U);
}

TEST(Volume, a_triangle_faces_the_light_from_its_front_alone_and_never_in_its_plane) {
    Scene scene = empty_scene();
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.triangles = {{0, 1, 2}};
    EXPECT_GT(side(scene, 0, {0.2, 0.2, 1e-300, 1}), 0);
    EXPECT_LT(side(scene, 0, {0.2, 0.2, -1e-300, 1}), 0);
    EXPECT_EQ(side(scene, 0, {7, 5, 0, 1}), 0);
    scene.lights[0].position = {7, 5, 0};
    EXPECT_TRUE(triangles_facing_light(scene).empty());
    scene.triangles = {{0, 1, 1}};
    EXPECT_EQ(side(scene, 0, {0, 0, 1, 1}), 0);
}

TEST(Volume, nothing_faces_the_light_nothing_is_made) {
    const ShadowVolume volume = extrude(empty_scene());
    EXPECT_TRUE(volume.light_cap.empty());
    EXPECT_TRUE(volume.sides.empty());
    EXPECT_TRUE(volume.dark_cap.empty());
}

} // namespace
} // namespace shadowproof::tests
