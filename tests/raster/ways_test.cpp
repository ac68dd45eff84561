// Five ways to make the same volumes.
#include "raster/render.h"
#include "scenes/catalog.h"
#include "scenes/topology.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof::tests {
namespace {

// 512 pixels: half of them is a power of two, by which the driver's two viewport transforms, behind
// a vertex and behind a geometry shader, multiply without rounding.
class Ways : public testing::TestWithParam<std::string> {};

TEST_P(Ways, all_give_the_same_stencil_bit_for_bit_where_every_caster_is_closed) {
    const Scene scene =
        load_scene(GetParam(), {.camera = {}, .light = {}, .time = 0, .width = 512, .height = 512});
    const Plan plan = make_plan(scene);
    if (plan.hole_filling) {
        // Only the half-edge mesh fills holes; and only these two have any.
        EXPECT_TRUE(GetParam() == "open_lid" || GetParam() == "t_junctions");
        GTEST_SKIP() << "has an open caster";
    }
    Gpu gpu(GlPlatform::osmesa);
    const Frame expected = render(*find_technique("zfail_reversed"), scene, plan, gpu);
    EXPECT_TRUE(
        std::ranges::any_of(expected.counter.pixels, [](auto count) { return count != 0; }));
    for (const char* technique : {"zfail_half_edge", "zfail_degenerate_quads",
                                  "zfail_geometry_shader", "zfail_per_triangle"}) {
        SCOPED_TRACE(technique);
        // Of a caster wound inside out, each triangle by itself throws shadows that the others
        // miss.
        if (GetParam() == "inverted" && technique == std::string("zfail_per_triangle")) continue;
        const Frame frame = render(*find_technique(technique), scene, plan, gpu);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < frame.counter.pixels.size(); ++i)
            differing += frame.counter.pixels[i] != expected.counter.pixels[i] ? 1U : 0U;
        EXPECT_EQ(differing, 0U);
    }
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const BundledScene& scene : bundled_scenes()) names.emplace_back(scene.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Bundled, Ways, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

} // namespace
} // namespace shadowproof::tests
