// A side of a volume that is seen edge-on, on the very line of the picture along which other sides
// begin: first seen in a scene made by chance, where two pixels had no explanation.
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

/// A closed prism over a figure of eight, two-sided, over a floor. Its edges along z lie in planes
/// with eye and light, that differ in z alone.
Scene prism_of_eight() {
    Scene scene = tests::empty_scene();
    scene.materials.front().double_sided = true;
    tests::add_rectangle(scene, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20});
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    const auto first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
    for (const float z : {-1.0F, 1.0F})
        for (const glm::vec2 at : {glm::vec2(-2, 0.5), {1, 1.5}, {1, 0.8}, {-2, 2}})
            scene.positions.emplace_back(at, z);
    for (const glm::uvec3 corners : {glm::uvec3(0, 1, 5),
                                     {0, 5, 4},
                                     {1, 2, 6},
                                     {1, 6, 5},
                                     {2, 3, 7},
                                     {2, 7, 6},
                                     {3, 0, 4},
                                     {3, 4, 7},
                                     {0, 2, 1},
                                     {4, 5, 6},
                                     {0, 3, 2},
                                     {4, 6, 7}})
        scene.triangles.push_back(corners + first);
    scene.meshes.push_back(
        {.name = "eight", .first_triangle = first_triangle, .triangle_count = 12});
    scene.lights[0].position = {4, 3, 1};
    tests::look_at(scene.camera, {4, 3, 5}, {0, 1, 0});
    scene.camera.half_height = std::tan(0.5 * 0.9);
    scene.camera.width = 512;
    scene.camera.height = 512;
    return scene;
}

TEST(EdgeOn, a_sliver_that_no_ray_meets_is_counted_and_predicted) {
    const tests::TracedScene traced(prism_of_eight());
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    const Comparison comparison = tests::compared(traced, frame);
    ASSERT_NE(frame.counted->counter.at(309, 295),
              tests::predicted_counter(traced, frame, 309, 295));
    EXPECT_EQ(comparison.evidence.unexplained, 0U);
    EXPECT_EQ(comparison.cause.at(309, 295), static_cast<std::uint8_t>(Cause::precision));
}

} // namespace
} // namespace shadowproof
