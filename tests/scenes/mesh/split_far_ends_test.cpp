#include "scenes/mesh/split_far_ends.h"
#include "tests/scenes/soups.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

/// A triangle in the plane y = 0, seen from above, one edge of it along z through the origin.
Scene triangle_below(const glm::dvec3& light) {
    Scene scene = test::soup({{0, 0, -1}, {-2, 0, 0}, {0, 0, 1}}, {{0, 1, 2}});
    if (side(scene, 0, glm::dvec4(0, 1, 0, 1)) < 0)
        std::swap(scene.triangles[0].x, scene.triangles[0].y);
    scene.lights.resize(1);
    scene.lights[0].position = light;
    return scene;
}

void expect_near(const glm::dvec3& direction, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(direction, expected), 1e-15)
        << direction.x << " " << direction.y << " " << direction.z;
}

TEST(SplitFarEnds, a_light_off_every_caster_splits_nothing) {
    EXPECT_TRUE(split_far_ends(triangle_below({-0.5, 0.01, 0})).empty());
    EXPECT_TRUE(split_far_ends(triangle_below({5, 0, 0})).empty());
    Scene sun = triangle_below({-0.5, 1e-12, 0});
    EXPECT_FALSE(split_far_ends(sun).empty());
    sun.lights[0].kind = Light::Kind::directional;
    EXPECT_TRUE(split_far_ends(sun).empty());
}

TEST(SplitFarEnds, behind_a_face_is_opposite_to_its_normal_however_near_the_light) {
    for (const double height : {1e-300, 1e-18, 1e-7}) {
        const SplitFarEnds split = split_far_ends(triangle_below({-0.5, height, 0.1}));
        ASSERT_NE(split.behind(0), nullptr);
        expect_near(split.directions[*split.behind(0)], {0, -1, 0});
        EXPECT_TRUE(split.across_edge.empty());
        EXPECT_TRUE(split.of_position.empty());
    }
}

TEST(SplitFarEnds, a_caster_that_does_not_face_the_light_is_not_split) {
    EXPECT_TRUE(split_far_ends(triangle_below({-0.5, 0, 0.1})).empty());
    EXPECT_TRUE(split_far_ends(triangle_below({-0.5, -1e-18, 0.1})).empty());
}

TEST(SplitFarEnds, across_an_edge_leads_to_its_point_next_to_the_light_however_near_that_is) {
    for (const double off : {1e-300, 1e-18, 1e-8}) {
        const SplitFarEnds split = split_far_ends(triangle_below({0.6 * off, 0.8 * off, 0.25}));
        const std::uint32_t* across = split.across(2, 0);
        ASSERT_NE(across, nullptr);
        EXPECT_EQ(across, split.across(0, 2));
        expect_near(split.directions[*across], {-0.6, -0.8, 0});
        // The nearest point of the triangle is there, too.
        ASSERT_NE(split.behind(0), nullptr);
        expect_near(split.directions[*split.behind(0)], {-0.6, -0.8, 0});
        EXPECT_EQ(split.across(0, 1), nullptr);
    }
}

TEST(SplitFarEnds, a_corner_next_to_the_light_has_its_own_direction) {
    const SplitFarEnds split = split_far_ends(triangle_below({0, 0x1p-60, 1 + 0x1p-52}));
    const Scene scene = triangle_below({0, 0, 0});
    std::uint32_t corner = 0;
    while (scene.positions[corner] != glm::vec3(0, 0, 1)) ++corner;
    ASSERT_NE(split.of(corner), nullptr);
    expect_near(split.directions[*split.of(corner)], glm::normalize(glm::dvec3(0, -0x1p-8, -1)));
}

TEST(SplitFarEnds, equal_positions_share_their_directions) {
    Scene scene = triangle_below({0.6e-9, 0.8e-9, 0.25});
    // The same triangle again, of positions of its own.
    for (int k = 0; k < 3; ++k)
        scene.positions.push_back(scene.positions[static_cast<std::size_t>(k)]);
    const SplitFarEnds split = split_far_ends(scene);
    ASSERT_NE(split.across(0, 2), nullptr);
    EXPECT_EQ(split.across(0, 2), split.across(3, 5));
    EXPECT_EQ(split.across(0, 2), split.across(5, 0));
}

} // namespace
} // namespace shadowproof
