// Five ways to make the same volumes.
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "scenes/mesh/topology.h"
#include "scenes/plan/plan.h"
#include "tests/raster/small_scenes.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof::tests {
namespace {

// 512 pixels: half of them is a power of two, by which the driver's two viewport transforms, behind
// a vertex and behind a geometry shader, multiply without rounding.
class Ways : public testing::TestWithParam<std::string> {};

/// Where one is open, the half-edge mesh alone fills its holes; of such a caster, and of one wound
/// inside out, each triangle by itself throws shadows that the others miss. Those must differ.
TEST_P(Ways, all_give_the_same_stencil_bit_for_bit_where_every_caster_is_closed) {
    const Scene scene =
        load_scene(GetParam(), {.camera = {}, .light = {}, .time = 0, .width = 512, .height = 512});
    const Plan plan = make_plan(scene);
    const std::vector<CasterReport> casters = inspect_casters(scene);
    const bool some_inverted = std::ranges::any_of(casters, &CasterReport::inverted);
    Gpu gpu(GlPlatform::osmesa);
    const Frame expected = render(*find_technique("zfail_reversed"), scene, plan, gpu);
    EXPECT_TRUE(std::ranges::any_of(expected.counted->counter.pixels,
                                    [](auto count) { return count != 0; }));
    for (const char* technique : {"zfail_half_edge", "zfail_degenerate_quads",
                                  "zfail_geometry_shader", "zfail_per_triangle"}) {
        SCOPED_TRACE(technique);
        const Frame frame = render(*find_technique(technique), scene, plan, gpu);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < frame.counted->counter.pixels.size(); ++i)
            differing +=
                frame.counted->counter.pixels[i] != expected.counted->counter.pixels[i] ? 1U : 0U;
        const bool fills_holes = plan.hole_filling && technique == std::string("zfail_half_edge");
        const bool by_itself =
            (plan.hole_filling || some_inverted) && technique == std::string("zfail_per_triangle");
        EXPECT_EQ(differing > 0, fills_holes || by_itself);
    }
}

// A box of two-sided glass around light and eye, and so near that the near plane and the picture's
// borders cut it: where its light caps were clipped otherwise than its surfaces, they would show as
// acne.
TEST(TurnedCasters, have_light_caps_at_the_depths_of_their_surfaces_also_where_they_are_clipped) {
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    add_box(scene, {-1, -0.5, -9}, {1, 0.7F, 6});
    scene.lights[0].position = {0.13, 0.41, 4.83};
    look_at(scene.camera, {0.31, 0.2, 5.7}, {-0.2, -0.1, 0});
    scene.camera.near = 0.6;
    scene.camera.width = scene.camera.height = 256;
    const Plan plan = make_plan(scene);
    ASSERT_FALSE(plan.around_light.empty());
    Gpu gpu(GlPlatform::osmesa);
    for (const char* technique :
         {"zfail_clamp", "zfail_infinite", "zfail_reversed", "zfail_half_edge",
          "zfail_degenerate_quads", "zfail_geometry_shader", "zfail_per_triangle", "zpass_capped",
          "auto"}) {
        SCOPED_TRACE(technique);
        const Frame frame = render(*find_technique(technique), scene, plan, gpu);
        int seen = 0;
        for (std::size_t i = 0; i < frame.counted->counter.pixels.size(); ++i) {
            if (frame.triangle.pixels[i] == no_triangle) continue; // past what the near plane cuts
            ++seen;
            ASSERT_EQ(frame.counted->counter.pixels[i], 0U) << i;
        }
        EXPECT_GT(seen, 50'000);
    }
}

SHADOWPROOF_OVER_SCENES(Ways, bundled_scene_names());

} // namespace
} // namespace shadowproof::tests
