#include "scenes/mesh/touching_light.h"
#include "scenes/plan/plan.h"
#include "tests/scenes/soups.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof {
namespace {

/// A triangle in no plane that floats hold exactly, under a point light.
Scene tilted_triangle(const glm::dvec3& light) {
    Scene scene =
        test::soup({{0.1F, 0.7F, -1.3F}, {2.1F, 0.9F, 0.2F}, {-0.4F, 1.6F, 1.1F}}, {{0, 1, 2}});
    scene.lights.resize(1);
    scene.lights[0].position = light;
    return scene;
}

/// The point of the triangle with these weights, moved along the normal.
glm::dvec3 near_triangle(const glm::dvec3& weights, double off) {
    const Scene scene = tilted_triangle({0, 0, 0});
    const glm::dvec3 a = corner(scene, 0, 0);
    const glm::dvec3 b = corner(scene, 0, 1);
    const glm::dvec3 c = corner(scene, 0, 2);
    return weights.x * a + weights.y * b + weights.z * c +
           off * glm::normalize(glm::cross(b - a, c - a));
}

TEST(TouchingLight, a_light_within_the_rounding_of_floats_touches_a_face_an_edge_and_a_corner) {
    for (const glm::dvec3 weights : {glm::dvec3(0.3, 0.3, 0.4), {0.5, 0.5, 0}, {0, 0, 1}})
        for (const double off : {0.0, 1e-15})
            EXPECT_EQ(triangles_touching_light(tilted_triangle(near_triangle(weights, off))).size(),
                      1U)
                << weights.x << " off by " << off;
    EXPECT_EQ(
        triangles_touching_light(tilted_triangle(near_triangle({0.3, 0.3, 0.4}, 1e-7))).size(), 1U);
}

TEST(TouchingLight, a_light_further_off_than_floats_round_touches_nothing) {
    for (const glm::dvec3 weights : {glm::dvec3(0.3, 0.3, 0.4), {0.5, 0.5, 0}, {0, 0, 1}})
        for (const double off : {1e-4, -1e-4, 1.0})
            EXPECT_TRUE(
                triangles_touching_light(tilted_triangle(near_triangle(weights, off))).empty())
                << weights.x << " off by " << off;
}

TEST(TouchingLight, a_light_in_the_plane_beside_the_triangle_touches_nothing) {
    EXPECT_TRUE(
        triangles_touching_light(tilted_triangle(near_triangle({-0.2, 0.6, 0.6}, 0))).empty());
}

TEST(TouchingLight, neither_a_sun_nor_what_casts_no_shadow_touches) {
    Scene scene = tilted_triangle(near_triangle({0.3, 0.3, 0.4}, 0));
    ASSERT_FALSE(triangles_touching_light(scene).empty());
    Scene silent = scene;
    silent.meshes[0].casts = false;
    EXPECT_TRUE(triangles_touching_light(silent).empty());
    scene.lights[0].kind = Light::Kind::directional;
    EXPECT_TRUE(triangles_touching_light(scene).empty());
}

TEST(TouchingLight, the_plan_names_the_caster) {
    const Plan plan = make_plan(tilted_triangle(near_triangle({0.3, 0.3, 0.4}, 0)));
    EXPECT_TRUE(std::ranges::any_of(plan.faults, [](const std::string& fault) {
        return fault.find("touches the light with 1 triangle:") != std::string::npos;
    }));
}

} // namespace
} // namespace shadowproof
