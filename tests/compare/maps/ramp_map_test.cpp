// The spot's map in two other ways: as bytes that two textures give, and drawn into the stencil.
#include "compare/evidence.h"
#include "compare/maps/lookup.h"
#include "compare/verdict.h"
#include "tests/compare/maps/drawn_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

using tests::all_texels;
using tests::compared;
using tests::drawn;
using tests::pixels_of;
using tests::small;
using tests::TracedScene;

class SpotMaps : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene spot{small("spot")};

    Frame ramp(const MapSettings& settings) {
        return drawn(gpu, spot, "spot_map_dual_texture", settings);
    }
};

TEST_F(SpotMaps, in_the_stencil_answer_as_without_it) {
    for (const double bias : {0.0, 0.05, 0.5}) {
        const MapSettings settings{.size = 200, .bias = bias};
        const Frame in_stencil = drawn(gpu, spot, "spot_map_stencil", settings);
        EXPECT_EQ(in_stencil.claim.pixels, drawn(gpu, spot, "spot_map", settings).claim.pixels);
        EXPECT_TRUE(is_explained(compared(spot, in_stencil)));
    }
}

TEST_F(SpotMaps, of_bytes_fail_by_precision_where_those_of_24_bits_do_not) {
    const MapSettings settings{.bias = 0.05, .far = 200}; // steps of 0.8
    const Comparison bytes = compared(spot, ramp(settings));
    EXPECT_TRUE(is_explained(bytes));
    EXPECT_GT(pixels_of(bytes, Cause::precision), 20U);
    const Comparison depths = compared(spot, drawn(gpu, spot, "spot_map", settings));
    EXPECT_EQ(pixels_of(depths, Cause::precision), 0U);
}

TEST_F(SpotMaps, of_bytes_err_less_the_closer_their_planes_are_to_the_scene) {
    const auto wrong = [&](double near, double far) {
        return compared(spot, ramp({.bias = 0.01, .near = near, .far = far})).differing;
    };
    const Comparison all = compared(spot, ramp({.bias = 0.01}));
    EXPECT_LT(all.differing, wrong(0.01, 200));
}

TEST_F(SpotMaps, of_bytes_with_a_texel_a_step_off_are_unexplained_but_where_two_steps_meet) {
    Frame frame = ramp({.size = 64});
    const std::unique_ptr<LightView> view =
        light_view(spot.scene, *frame.mapped, frame.depth_model.subpixel_bits, 0);
    const std::vector<Texel> texels = all_texels(frame.mapped->model);
    const std::vector<FromLight> at_centres = view->trace_without({}, texels);
    int caught = 0;
    int tried = 0;
    for (std::size_t i = 0; i < texels.size(); i += 3) {
        if (at_centres[i].triangle == no_triangle) continue;
        float& stored = frame.mapped->faces[0].at(texels[i].x, texels[i].y);
        const float right = stored;
        EXPECT_TRUE(view->shown(texels[i], at_centres[i].triangle)) << i;
        stored = static_cast<float>((std::round(right * 255.0) - 1) / 255);
        ++tried;
        caught += view->shown(texels[i], at_centres[i].triangle) ? 0 : 1;
        stored = right;
    }
    EXPECT_GT(tried, 100);
    // A face that is steep as seen from the light may be a step nearer within a 512th of a texel.
    EXPECT_GT(caught, tried * 9 / 10);
}

TEST(Ramp, has_256_steps_from_the_near_to_the_far_plane) {
    MapModel model = ramp_model();
    model.near = 1;
    model.far = 5;
    EXPECT_EQ(ramp_step(place_on_ramp(model, 1)), 0);
    EXPECT_EQ(ramp_step(place_on_ramp(model, 3)), 128);
    EXPECT_EQ(ramp_step(place_on_ramp(model, std::nextafter(3, 0))), 127);
    EXPECT_EQ(ramp_step(place_on_ramp(model, 5)), 255);
    EXPECT_EQ(ramp_step(place_on_ramp(model, 0)), 0);
    EXPECT_EQ(ramp_step(place_on_ramp(model, 9)), 255);
    for (int step = 0; step < ramp_steps; ++step)
        EXPECT_EQ(ramp_step(place_on_ramp(model, value_of_stored(model, step / 255.0))), step);
}

TEST(Ramp, compares_steps_and_answers_both_ways_only_where_they_meet) {
    MapModel model = ramp_model();
    model.near = 1;
    model.far = 5;
    model.bias = 0;
    const auto answers = [&](int step, double own) {
        return compare(model, step / 255.0, own, own);
    };
    // In the same step either depth may be the greater one: it is lit.
    EXPECT_TRUE(answers(128, 3.01).lit);
    EXPECT_FALSE(answers(128, 3.01).shadowed);
    EXPECT_FALSE(answers(127, 3.01).lit);
    EXPECT_TRUE(answers(127, 3.0).lit);
    EXPECT_TRUE(answers(127, 3.0).shadowed);
    EXPECT_TRUE(is_shadowed(model, 127 / 255.0, 3.0));
    model.bias = 0.02;
    EXPECT_FALSE(is_shadowed(model, 127 / 255.0, 3.01));
}

} // namespace
} // namespace shadowproof
