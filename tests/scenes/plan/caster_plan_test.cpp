#include "scenes/plan/caster_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

/// The eye at (0, 1, 10) looks along -z, 90 degrees wide, near 1; the light stands at (0, 9, 0).
Scene empty_stage() {
    Scene scene;
    scene.materials = {{"plain", false}};
    scene.camera.eye = {0, 1, 10};
    scene.camera.near = 1;
    scene.lights.emplace_back();
    scene.lights[0].position = {0, 9, 0};
    return scene;
}

/// Counter-clockwise quads of an axis-aligned box as one mesh.
void add_box(Scene& scene, const char* name, const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (unsigned i = 0; i < 8; ++i)
        scene.positions.emplace_back((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                                     (i & 4U) != 0 ? high.z : low.z);
    const auto mesh = static_cast<std::uint32_t>(scene.triangles.size());
    for (const auto& [a, b, c, d] : std::initializer_list<std::array<std::uint32_t, 4>>{
             {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
        scene.triangles.emplace_back(first + a, first + b, first + c);
        scene.triangles.emplace_back(first + a, first + c, first + d);
    }
    scene.meshes.push_back({name, mesh, 12, 0});
}

/// The floor's top is the plane y = 0.
Scene floor_alone() {
    Scene scene = empty_stage();
    add_box(scene, "floor", {-3, -1, -3}, {3, 0, 3});
    return scene;
}

/// A floor on which the shadow of what hangs between light and eye is seen.
Scene long_floor() {
    Scene scene = empty_stage();
    add_box(scene, "floor", {-3, -1, -3}, {3, 0, 9});
    return scene;
}

bool is_left_out(const Scene& scene, std::size_t mesh) {
    return !plan_casters(scene).at(mesh).left_out.empty();
}

TEST(caster_plan, a_floor_and_what_stands_on_it_shadow_no_lit_side_of_themselves) {
    Scene scene = floor_alone();
    EXPECT_TRUE(is_left_out(scene, 0));
    add_box(scene, "box on it", {-1, 0, -1}, {1, 1, 1}); // touches the floor, exactly
    EXPECT_TRUE(is_left_out(scene, 0));
    EXPECT_FALSE(is_left_out(scene, 1)); // its shadow falls on the floor
}

TEST(caster_plan, what_dips_below_a_floors_top_may_be_shadowed_by_it) {
    Scene scene = floor_alone();
    add_box(scene, "pillar beside it", {4, -4, -1}, {5, 1, 1}); // its foot is in the shadow
    EXPECT_FALSE(is_left_out(scene, 0));
}

TEST(caster_plan, a_shadow_that_falls_beside_all_that_is_seen_needs_no_volume) {
    Scene scene = floor_alone();
    add_box(scene, "far aside", {8, 5, -1},
            {9, 6, 1}); // its shadow falls ever further to the right
    EXPECT_TRUE(is_left_out(scene, 1));
    scene.lights[0].position = {14, 9, 0}; // now it falls on the floor
    EXPECT_FALSE(is_left_out(scene, 1));
}

TEST(caster_plan, what_is_behind_the_eye_is_left_out_until_its_shadow_comes_into_the_picture) {
    Scene scene = floor_alone();
    add_box(scene, "behind", {-1, 6, 13}, {1, 7, 14});
    EXPECT_TRUE(is_left_out(scene, 1));
    scene.lights[0].position = {0, 12, 26};
    EXPECT_FALSE(is_left_out(scene, 1));
}

TEST(caster_plan, a_room_around_the_light_shadows_nothing_in_it) {
    Scene scene = empty_stage();
    scene.lights[0].position = {0, 3, 0};
    add_box(scene, "room", {-20, -2, -20}, {20, 20, 20});
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.y, triangle.z); // inside out
    add_box(scene, "box", {-1, -1, -1}, {1, 1, 1});
    EXPECT_TRUE(is_left_out(scene, 0));
    EXPECT_FALSE(is_left_out(scene, 1));
    scene.lights[0].position = {0, 30, 0}; // above the ceiling, which shadows all
    EXPECT_FALSE(is_left_out(scene, 0));
}

TEST(caster_plan, what_shows_no_shadows_asks_for_none) {
    Scene scene = floor_alone();
    add_box(scene, "box", {-1, 1, -1}, {1, 2, 1});
    scene.meshes[0].receives = false;
    EXPECT_TRUE(is_left_out(scene, 1));
}

TEST(caster_plan, a_volume_around_the_eye_or_the_near_plane_is_counted_behind_the_surface) {
    Scene scene = long_floor();
    add_box(scene, "box", {-1, 1, -1}, {1, 2, 1});
    EXPECT_FALSE(plan_casters(scene)[1].meets_near);
    add_box(scene, "lid", {-1, 4, 4}, {1, 4.5F, 8}); // between the light and the eye
    EXPECT_TRUE(plan_casters(scene)[2].meets_near);
    EXPECT_FALSE(plan_casters(scene)[1].meets_near);
}

TEST(caster_plan, meshes_that_share_a_corner_are_counted_alike) {
    Scene scene = long_floor();
    add_box(scene, "lid", {-1, 4, 4}, {1, 4.5F, 8});
    add_box(scene, "knob", {1, 4.5F, 4}, {1.1F, 4.6F, 4.1F});
    const std::vector<CasterPlan> plans = plan_casters(scene);
    EXPECT_TRUE(plans[1].meets_near);
    EXPECT_TRUE(plans[2].meets_near); // by itself its volume does not
    scene.positions.back() += glm::vec3(0, 1, 0);
    for (std::size_t i = 16; i < 24; ++i) scene.positions[i].y += 0.1F; // apart
    EXPECT_FALSE(plan_casters(scene)[2].meets_near);
}

std::size_t surfaces_among(const Scene& scene, std::size_t mesh, bool far_clips) {
    const std::vector<std::uint8_t> certain = certain_surfaces(scene, far_clips);
    const auto first = certain.begin() + scene.meshes[mesh].first_triangle;
    return static_cast<std::size_t>(
        std::count(first, first + scene.meshes[mesh].triangle_count, std::uint8_t{1}));
}

TEST(certain_surfaces, are_the_fronts_that_the_eye_sees_and_all_that_is_double_sided) {
    Scene scene = empty_stage();
    add_box(scene, "box", {-1, -4, -1}, {1, 0, 1}); // the eye sees its top and its front
    EXPECT_EQ(surfaces_among(scene, 0, true), 4U);
    scene.camera.eye.y = -2; // its front alone
    EXPECT_EQ(surfaces_among(scene, 0, true), 2U);
    scene.materials[0].double_sided = true;
    EXPECT_EQ(surfaces_among(scene, 0, true), 12U);
    scene.materials[0].double_sided = false;
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.y, triangle.z);
    EXPECT_EQ(surfaces_among(scene, 0, true), 10U); // all but its front, from within
}

TEST(certain_surfaces, are_none_that_snapping_may_turn_over_or_that_a_plane_may_cut) {
    Scene scene = empty_stage();
    add_box(scene, "box", {-1, -4, -1}, {1, 0, 1});
    scene.camera.eye.y = 1e-3; // its top is seen at a fraction of a pixel
    EXPECT_EQ(surfaces_among(scene, 0, true), 2U);
    scene.camera.eye = {0, 1, 1.5}; // its front is nearer than the near plane
    EXPECT_EQ(surfaces_among(scene, 0, true), 0U);
    scene.camera.eye = {0, 1, 10};
    scene.camera.far = 10; // cuts the top
    EXPECT_EQ(surfaces_among(scene, 0, true), 4U);
    EXPECT_EQ(surfaces_among(scene, 0, false), 2U);
}

TEST(caster_plan, only_a_volume_thrown_ahead_of_the_eye_may_be_seen_at_infinity) {
    Scene scene = floor_alone();
    add_box(scene, "box", {-1, 1, -1}, {1, 2, 1});
    EXPECT_FALSE(plan_casters(scene)[1].reaches_infinity);
    scene.lights[0].position = {0, 2, 14};
    EXPECT_TRUE(plan_casters(scene)[1].reaches_infinity);
}

} // namespace
} // namespace shadowproof
