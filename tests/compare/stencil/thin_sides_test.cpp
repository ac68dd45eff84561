// Sides of a fine mesh's volumes are long and thin in the picture, and the set-up of their depths
// rounds: first seen with a million triangles, where pixels had no explanation before.
#include "compare/driver/setup_error.h"
#include "tests/compare/traced_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

namespace shadowproof {
namespace {

/// A closed ball with bumps, that shadows itself; its triangles are about as large as pixels.
Scene bumpy_ball(unsigned rings, unsigned sectors) {
    Scene scene;
    scene.materials = {{"plain", false}};
    const double pi = glm::radians(180.0);
    scene.positions.emplace_back(0, 1, 0);
    for (unsigned i = 1; i < rings; ++i)
        for (unsigned k = 0; k < sectors; ++k) {
            const double theta = pi * i / rings;
            const double phi = 2 * pi * k / sectors;
            const double radius = 1 + 0.08 * std::sin(9 * theta) * std::sin(12 * phi);
            scene.positions.emplace_back(radius * std::sin(theta) * std::cos(phi),
                                         radius * std::cos(theta),
                                         radius * std::sin(theta) * std::sin(phi));
        }
    scene.positions.emplace_back(0, -1, 0);
    const auto last = static_cast<std::uint32_t>(scene.positions.size() - 1);
    const auto at = [&](unsigned i, unsigned k) { return 1 + (i - 1) * sectors + k % sectors; };
    for (unsigned k = 0; k < sectors; ++k) {
        scene.triangles.emplace_back(0, at(1, k + 1), at(1, k));
        scene.triangles.emplace_back(last, at(rings - 1, k), at(rings - 1, k + 1));
        for (unsigned i = 1; i + 1 < rings; ++i) {
            scene.triangles.emplace_back(at(i, k), at(i, k + 1), at(i + 1, k));
            scene.triangles.emplace_back(at(i + 1, k), at(i, k + 1), at(i + 1, k + 1));
        }
    }
    scene.meshes = {{"ball", 0, static_cast<std::uint32_t>(scene.triangles.size()), 0}};
    scene.camera.eye = {0, 0, 4.2};
    scene.camera.half_height = 0.3;
    scene.camera.near = 0.1;
    scene.camera.width = 640;
    scene.camera.height = 640;
    scene.lights.emplace_back();
    scene.lights[0].position = {2.5, 3.5, 1.5};
    return scene;
}

TEST(ThinSides, every_pixel_of_a_mesh_as_fine_as_the_picture_is_explained) {
    const tests::TracedScene traced(bumpy_ball(320, 320));
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"zfail_reversed", "zfail_saturate", "zpass", "auto"}) {
        SCOPED_TRACE(name);
        const Comparison comparison = tests::compared(traced, name, gpu);
        EXPECT_EQ(comparison.evidence.unexplained, 0U);
        EXPECT_EQ(tests::pixels_of(comparison, Cause::unexplained), 0U);
        EXPECT_GT(comparison.differing, 0U);
    }
}

/// One upright triangle at depth 5 whose right edge throws a side to the left and down.
double error_of_side(double edge_length) {
    Scene scene = bumpy_ball(3, 3);
    scene.camera.eye = {0, 0, 5};
    scene.positions = {{0, 0, 0}, {0, static_cast<float>(edge_length), 0}, {-1, 0, 0}};
    scene.triangles = {{0, 1, 2}};
    scene.lights[0].position = {4, 1, 1};
    const Crossing side{.depth = 5, .change = 1, .part = Crossing::Part::side_0, .triangle = 0};
    return setup_error(scene, nullptr, side, {{0, 0, -1}, 1, {.near = 0.1}});
}

/// And more, as corners that are off take away some of it; where they may take all, nothing is
/// known.
TEST(ThinSides, half_the_width_doubles_what_rounding_may_do) {
    const double wide = error_of_side(0.0002);
    const double thin = error_of_side(0.0001);
    EXPECT_GT(wide, 0);
    EXPECT_GT(thin / wide, 2);
    EXPECT_LT(thin / wide, 2.5);
    EXPECT_TRUE(std::isinf(error_of_side(0.00001)));
    EXPECT_TRUE(std::isinf(error_of_side(0)));
}

} // namespace
} // namespace shadowproof
