// A light on a caster, as near as floats tell: every technique may then take it to be on either
// side, and what that does to whole pictures is foreseen.
#include "scenes/touching_light.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

using tests::compared;
using tests::pixels_of;

/// A box turned so that floats do not hold its faces' planes, over a floor; the light over a point
/// of one of its triangles, off by a length.
Scene light_on_box(std::uint32_t triangle, double off) {
    Scene scene = tests::box_over_floor();
    scene.camera.width = 64;
    scene.camera.height = 64;
    const Mesh& box = scene.meshes.front();
    const glm::dvec3 middle(0, 1.5, 0);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    std::vector<std::uint8_t> turned(scene.positions.size(), 0);
    for (std::uint32_t i = 0; i < box.triangle_count; ++i)
        for (int k = 0; k < 3; ++k) turned[scene.triangles[box.first_triangle + i][k]] = 1;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        if (turned[i] == 0) continue;
        const glm::dvec3 p = glm::dvec3(scene.positions[i]) - middle; // by 1 radian (Rodrigues)
        scene.positions[i] = middle + p * std::cos(1.0) + glm::cross(axis, p) * std::sin(1.0) +
                             axis * glm::dot(axis, p) * (1 - std::cos(1.0));
    }
    const std::uint32_t on = box.first_triangle + triangle;
    const glm::dvec3 a = corner(scene, on, 0);
    const glm::dvec3 b = corner(scene, on, 1);
    const glm::dvec3 c = corner(scene, on, 2);
    const glm::vec3 point(0.3 * a + 0.3 * b + 0.4 * c); // rounded
    scene.lights[0].position = glm::dvec3(point) + off * glm::normalize(glm::cross(b - a, c - a));
    return scene;
}

TEST(TouchingLight, on_a_face_turns_whole_pictures_over_and_each_pixel_is_foreseen) {
    Gpu gpu(GlPlatform::osmesa);
    std::uint64_t turned_over = 0;
    for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
        const tests::TracedScene traced(light_on_box(triangle, 0));
        ASSERT_FALSE(triangles_touching_light(traced.scene).empty());
        for (const char* technique : {"zfail_clamp", "zfail_reversed", "zfail_per_triangle",
                                      "zfail_degenerate_quads", "zpass", "auto"}) {
            const Comparison comparison = compared(traced, technique, gpu);
            EXPECT_EQ(comparison.ledger.unexplained, 0U) << technique << " on " << triangle;
            EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U)
                << technique << " on " << triangle;
            turned_over += pixels_of(comparison, Cause::precision);
        }
    }
    EXPECT_GT(turned_over, 1000U);
}

TEST(TouchingLight, a_ten_thousandth_off_the_face_the_pictures_are_right) {
    Gpu gpu(GlPlatform::osmesa);
    for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
        const tests::TracedScene traced(light_on_box(triangle, 1e-4));
        ASSERT_TRUE(triangles_touching_light(traced.scene).empty());
        const Comparison comparison = compared(traced, "zfail_reversed", gpu);
        EXPECT_EQ(comparison.ledger.unexplained, 0U) << triangle;
        EXPECT_LE(pixels_of(comparison, Cause::precision), 4U) << triangle;
        EXPECT_EQ(comparison.differing,
                  pixels_of(comparison, Cause::precision) + pixels_of(comparison, Cause::edge))
            << triangle;
    }
}

} // namespace
} // namespace shadowproof
