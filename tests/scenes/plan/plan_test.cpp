#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

namespace shadowproof {
namespace {

/// One triangle; the eye at the origin looks down -z, near 1, far 10, 90 degrees wide.
Scene one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                   const glm::dvec3& light) {
    Scene scene;
    scene.positions = {a, b, c};
    scene.triangles = {{0, 1, 2}};
    scene.meshes = {{"triangle", 0, 1, 0}};
    scene.materials = {{"plain", false}};
    scene.camera.near = 1;
    scene.camera.far = 10;
    scene.lights.emplace_back();
    scene.lights[0].position = light;
    return scene;
}

TEST(plan, a_triangle_between_light_and_near_plane_throws_its_volume_there) {
    const Plan plan =
        make_plan(one_triangle({-.1F, 2, -1}, {.1F, 2, -1}, {0, 2, -1.1F}, {0, 4, -1}));
    EXPECT_TRUE(plan.volume_meets_near);
    EXPECT_TRUE(plan.hole_filling);
}

TEST(plan, a_triangle_behind_the_light_throws_nothing_on_the_near_plane) {
    EXPECT_FALSE(
        make_plan(one_triangle({-1, 5, -1}, {1, 5, -1}, {0, 5, -2}, {0, 4, -1})).volume_meets_near);
}

TEST(plan, a_light_in_the_near_plane_is_no_special_case) {
    // Light at (0,3,-1), in the plane z = -1 of the near rectangle.
    EXPECT_TRUE(make_plan(one_triangle({-.1F, 2, -.9F}, {.1F, 2, -.9F}, {0, 2, -1.1F}, {0, 3, -1}))
                    .volume_meets_near);
    EXPECT_FALSE(
        make_plan(one_triangle({-1, 0, -5}, {1, 0, -5}, {0, 1, -5}, {0, 3, -1})).volume_meets_near);
}

TEST(plan, a_volume_thrown_ahead_meets_the_far_plane_and_is_seen_to_infinity) {
    const Plan plan = make_plan(one_triangle({-1, -1, -5}, {1, -1, -5}, {0, 1, -5}, {0, 0, 1}));
    EXPECT_TRUE(plan.volume_meets_far);
    EXPECT_TRUE(plan.dark_cap);
}

TEST(plan, a_volume_thrown_straight_down_is_not_seen_to_infinity) {
    const Plan plan = make_plan(one_triangle({-1, 0, -5}, {1, 0, -5}, {0, 0, -6}, {0, 3, -5.3}));
    EXPECT_FALSE(plan.dark_cap);
    EXPECT_FALSE(plan.volume_meets_far);
}

/// The same under a directional light.
Scene under_sun(Scene scene, const glm::dvec3& to_light) {
    scene.lights[0].kind = Light::Kind::directional;
    scene.lights[0].direction = -glm::normalize(to_light);
    return scene;
}

TEST(plan, a_sun_throws_volumes_on_the_planes_that_lie_along_its_rays_only) {
    const Scene level = one_triangle({-1, 0, -5}, {1, 0, -5}, {0, 0, -6}, {});
    const Plan from_above = make_plan(under_sun(level, {0, 1, 0}));
    EXPECT_FALSE(from_above.volume_meets_near);
    EXPECT_FALSE(from_above.volume_meets_far);
    const Scene upright = one_triangle({-1, -1, -5}, {1, -1, -5}, {0, 1, -5}, {});
    const Plan from_ahead = make_plan(under_sun(upright, {0, 0.1, -1}));
    EXPECT_TRUE(from_ahead.volume_meets_near);
    EXPECT_FALSE(from_ahead.volume_meets_far);
    const Plan from_behind = make_plan(under_sun(upright, {0, 0.1, 1}));
    EXPECT_FALSE(from_behind.volume_meets_near);
    EXPECT_TRUE(from_behind.volume_meets_far);
}

TEST(plan, a_suns_volumes_end_in_one_point_which_no_cap_covers) {
    const Scene upright = one_triangle({-1, -1, -5}, {1, -1, -5}, {0, 1, -5}, {0, 0, 1});
    EXPECT_TRUE(make_plan(upright).dark_cap);
    EXPECT_FALSE(make_plan(under_sun(upright, {0, 0, 1})).dark_cap);
}

TEST(plan, what_does_not_cast_has_no_volume_and_needs_no_filling) {
    Scene scene = one_triangle({-.1F, 2, -1}, {.1F, 2, -1}, {0, 2, -1.1F}, {0, 4, -1});
    scene.meshes[0].casts = false;
    const Plan plan = make_plan(scene);
    EXPECT_FALSE(plan.volume_meets_near || plan.volume_meets_far || plan.dark_cap ||
                 plan.hole_filling);
    scene.meshes[0].casts = true;
    EXPECT_TRUE(make_plan(scene).volume_meets_near && make_plan(scene).hole_filling);
}

TEST(plan, the_finite_far_plane_lies_behind_everything) {
    Scene scene = one_triangle({-1, 0, -5}, {1, 0, -5}, {0, 0, -6}, {0, 3, -5});
    EXPECT_EQ(finite_far(scene), 10);
    scene.camera.far = std::numeric_limits<double>::infinity();
    EXPECT_EQ(finite_far(scene), 9);
    for (glm::vec3& position : scene.positions) position.z = 1; // all behind the eye
    EXPECT_EQ(finite_far(scene), 2);
}

/// Does the segment from `from` to `to` cross the triangle? In double, ties as they round.
bool crosses(const glm::dvec3& from, const glm::dvec3& to, const Scene& scene) {
    const glm::dvec3 a = corner(scene, 0, 0);
    const glm::dvec3 ab = corner(scene, 0, 1) - a;
    const glm::dvec3 ac = corner(scene, 0, 2) - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double det = glm::dot(normal, from - to);
    const double t = glm::dot(normal, from - a) / det;
    const glm::dvec3 across = glm::cross(from - a, to - from);
    const double u = glm::dot(ac, across) / det;
    const double v = -glm::dot(ab, across) / det;
    return t > 0 && t < 1 && u >= 0 && v >= 0 && u + v <= 1;
}

TEST(plan, nothing_that_random_rays_find_was_ruled_out) {
    std::mt19937 random(4711);
    std::uniform_real_distribution<double> wide(-12, 12);
    std::uniform_real_distribution<double> unit(0, 1);
    int ruled_out = 0;
    int found = 0;
    for (int round = 0; round < 3000; ++round) {
        const auto point = [&] { return glm::vec3(wide(random), wide(random), wide(random)); };
        const Scene scene = one_triangle(point(), point(), point(), glm::dvec3(point()));
        const Plan plan = make_plan(scene);
        const glm::dvec3 light = chosen_light(scene).position;
        ruled_out += !plan.volume_meets_near + !plan.volume_meets_far + !plan.dark_cap;
        for (int ray = 0; ray < 40; ++ray) {
            const glm::dvec3 direction =
                line_of_sight(scene.camera, 512 * unit(random), 512 * unit(random));
            const bool near = crosses(direction, light, scene);
            const bool far = crosses(10.0 * direction, light, scene);
            const bool infinity = crosses(light, light + 1e6 * direction, scene);
            found += near + far + infinity;
            ASSERT_TRUE(plan.volume_meets_near || !near) << "round " << round;
            ASSERT_TRUE(plan.volume_meets_far || !far) << "round " << round;
            ASSERT_TRUE(plan.dark_cap || !infinity) << "round " << round;
        }
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(ruled_out, 3000);
}

TEST(plan, each_faulty_caster_gets_a_line_up_to_twenty_and_the_others_are_counted) {
    Scene scene = one_triangle({-1, 0, -5}, {1, 0, -5}, {0, 0, -6}, {0, 2.5, -5});
    EXPECT_EQ(make_plan(scene).faults.size(), 1U);
    EXPECT_EQ(make_plan(scene).faults[0].find("caster 'triangle' is open: 3 boundary edges in 1"),
              0U);
    for (unsigned i = 1; i < 23; ++i) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (unsigned k = 0; k < 3; ++k)
            scene.positions.push_back(scene.positions[k] + glm::vec3(0, i, 0));
        scene.meshes.push_back({"triangle", i, 1, 0});
        scene.triangles.emplace_back(first, first + 1, first + 2);
    }
    const std::vector<std::string> faults = make_plan(scene).faults;
    ASSERT_EQ(faults.size(), 21U);
    EXPECT_EQ(faults.back(), "3 more casters are open, inverted or not two-manifold");
}

TEST(plan, nothing_that_random_rays_to_a_sun_find_was_ruled_out) {
    constexpr std::uint32_t seed = 4712;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> wide(-12, 12);
    std::uniform_real_distribution<double> unit(0, 1);
    int ruled_out = 0;
    int found = 0;
    for (int round = 0; round < 3000; ++round) {
        const auto point = [&] { return glm::vec3(wide(random), wide(random), wide(random)); };
        const Scene scene =
            under_sun(one_triangle(point(), point(), point(), {}), glm::dvec3(point()));
        const Plan plan = make_plan(scene);
        const glm::dvec3 to_light(homogeneous(chosen_light(scene)));
        ruled_out += !plan.volume_meets_near + !plan.volume_meets_far;
        for (int ray = 0; ray < 40; ++ray) {
            const glm::dvec3 direction =
                line_of_sight(scene.camera, 512 * unit(random), 512 * unit(random));
            const bool near = crosses(direction, direction + 1e3 * to_light, scene);
            const bool far = crosses(10.0 * direction, 10.0 * direction + 1e3 * to_light, scene);
            found += near + far;
            ASSERT_TRUE(plan.volume_meets_near || !near) << "seed " << seed << ", round " << round;
            ASSERT_TRUE(plan.volume_meets_far || !far) << "seed " << seed << ", round " << round;
        }
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(ruled_out, 2000);
}

TEST(plan, bundled_scenes_need_what_they_provoke_and_no_more) {
    const auto plan_of = [](const char* name) { return make_plan(load_scene(name, {})); };
    const Plan ordinary = plan_of("ordinary");
    EXPECT_FALSE(ordinary.hole_filling || ordinary.dark_cap || ordinary.volume_meets_near ||
                 ordinary.volume_meets_far);
    EXPECT_EQ(ordinary.left_out.size(), 6U);
    EXPECT_TRUE(plan_of("near_plane").volume_meets_near);
    EXPECT_FALSE(plan_of("near_plane").volume_meets_far);
    EXPECT_TRUE(plan_of("far_plane").volume_meets_far);
    EXPECT_TRUE(plan_of("far_plane").dark_cap);
    EXPECT_FALSE(plan_of("far_plane").volume_meets_near);
    EXPECT_TRUE(plan_of("eye_inside").volume_meets_near);
}

TEST(plan, leaves_tangents_out_exactly_where_no_surface_has_a_bump_map) {
    const auto says_so = [](const char* name) {
        const std::vector<std::string> left_out = make_plan(load_scene(name, {})).left_out;
        return std::find(left_out.begin(), left_out.end(),
                         "tangents: no normal map or height field") != left_out.end();
    };
    EXPECT_TRUE(says_so("ordinary"));
    EXPECT_FALSE(says_so("bumpy_sphere"));
    EXPECT_FALSE(says_so("height_field"));
}

TEST(plan, a_scene_without_bump_maps_holds_nothing_that_lighting_would_need) {
    for (const BundledScene& bundled : bundled_scenes()) {
        const Scene scene = load_scene(std::string(bundled.name), {});
        const bool has_bump_map =
            std::any_of(scene.materials.begin(), scene.materials.end(),
                        [](const Material& material) { return material.bump != Bump::none; });
        EXPECT_EQ(scene.surfaces.size(), has_bump_map ? 3 * scene.triangles.size() : 0U)
            << bundled.name;
        EXPECT_EQ(scene.textures.empty(), !has_bump_map) << bundled.name;
    }
}

} // namespace
} // namespace shadowproof
