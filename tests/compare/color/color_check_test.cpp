// Colours are judged by intervals that are derived, pixel by pixel: what lies just outside is
// caught, as is the colour of another surface, another visibility and a fault.
#include "compare/verdict.h"
#include "scenes/load/catalog.h"
#include "tests/compare/color/judged_colors.h"
#include "tests/raster/faulty_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

namespace shadowproof {
namespace {

using tests::colors_of;
using tests::techniques_for;
using tests::traced;
using tests::TracedScene;

/// What a pixel shows instead of its colour, in the channel 0.
ColorVerdict verdict_with(const TracedScene& scene, Frame frame, int x, int y, double red) {
    frame.color.at(x, y).r = static_cast<float>(red);
    return check_colors(scene.tracer, scene.truth, frame).verdict.at(x, y);
}

/// Of bytes and of floats, at a pixel in the light.
TEST(Colors, just_outside_of_the_bound_are_caught_and_just_inside_pass) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_sphere", 64);
    for (const char* name : {"bump_tangent_space", "bump_eye_space", "bump_three_pass"}) {
        SCOPED_TRACE(name);
        const Frame frame = render(*find_technique(name), scene.scene, scene.plan, gpu);
        int tried = 0;
        for (int y = 0; y < 64 && tried < 20; ++y)
            for (int x = y % 7; x < 64; x += 7) {
                const ColorAccount own = account_for_color(scene.tracer, scene.truth, frame, x, y);
                if (own.verdict != ColorVerdict::within || own.truth.diffuse < 0.1) continue;
                // Of a colour that is nowhere near, all that may be right is asked for.
                Frame red = frame;
                red.color.at(x, y).r = 5;
                const ColorAccount account =
                    account_for_color(scene.tracer, scene.truth, red, x, y);
                EXPECT_EQ(account.verdict, ColorVerdict::unexplained);
                const Interval& bound = account.bound[0];
                const Interval& predicted = account.predicted[0];
                const double low = std::max(bound.low, predicted.low);
                const double high = std::min(bound.high, predicted.high);
                constexpr double little = 0.001 / 255; // a thousandth of a step
                EXPECT_NE(verdict_with(scene, frame, x, y, high + little), ColorVerdict::within);
                EXPECT_NE(verdict_with(scene, frame, x, y, low - little), ColorVerdict::within);
                EXPECT_EQ(verdict_with(scene, frame, x, y, 0.5 * (low + high)),
                          ColorVerdict::within);
                ++tried;
            }
        EXPECT_GT(tried, 5);
    }
}

TEST(Colors, of_floats_that_are_off_by_two_steps_are_never_right) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"bumpy_sphere", "fine_relief", "height_field"}) {
        SCOPED_TRACE(name);
        const TracedScene& scene = traced(name, 128);
        for (const char* technique : {"bump_tangent_space", "bump_eye_space"}) {
            Frame frame = render(*find_technique(technique), scene.scene, scene.plan, gpu);
            for (glm::vec3& color : frame.color.pixels) color += 2.F / 255;
            const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
            EXPECT_EQ(std::count(colors.verdict.pixels.begin(), colors.verdict.pixels.end(),
                                 ColorVerdict::within),
                      0);
            EXPECT_GT(colors.unpredicted, colors.judged / 2);
        }
    }
}

TEST(Colors, of_the_background_are_black_and_the_least_number_else_is_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_sphere", 64);
    for (const char* name : {"bump_tangent_space", "bump_eye_space", "bump_three_pass"}) {
        SCOPED_TRACE(name);
        const Frame frame = render(*find_technique(name), scene.scene, scene.plan, gpu);
        std::uint64_t background = 0;
        for (std::size_t i = 0; i < frame.color.pixels.size(); ++i)
            if (frame.triangle.pixels[i] == no_triangle) ++background;
        EXPECT_GT(background, 100U);
        EXPECT_EQ(check_colors(scene.tracer, scene.truth, frame).unpredicted, 0U);
        for (const float red :
             {1.0F, 1 / 255.0F, std::numeric_limits<float>::denorm_min(),
              -std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::quiet_NaN()}) {
            Frame cleared = frame;
            for (std::size_t i = 0; i < cleared.color.pixels.size(); ++i)
                if (frame.triangle.pixels[i] == no_triangle) cleared.color.pixels[i].r = red;
            const Comparison comparison = tests::compared(scene, cleared);
            EXPECT_EQ(comparison.colors->unpredicted, background) << red;
            EXPECT_EQ(judge(scene.scene, {}, {}, comparison), Verdict::unexplained) << red;
        }
    }
}

/// The frame is right, and the truth it is judged by is not.
TEST(Colors, of_a_wrong_visibility_or_surface_are_those_of_what_is_shown) {
    Gpu gpu(GlPlatform::osmesa);
    SceneRequest request;
    request.width = request.height = 96;
    for (const char* name : {"bumpy_sphere", "coarse_curve", "height_field"}) {
        const TracedScene scene(load_scene(name, request));
        for (const Technique* technique : techniques_for(scene.scene)) {
            SCOPED_TRACE(name + (", " + std::string(technique->name)));
            const Frame right = render(*technique, scene.scene, scene.plan, gpu);
            GroundTruth other = scene.truth;
            std::uint64_t wrong = 0;
            for (std::size_t i = 0; i < other.visibility.pixels.size(); ++i) {
                Visibility& visibility = other.visibility.pixels[i];
                if (visibility == Visibility::background) continue;
                // In turns: a triangle that is not seen there, visibility, neither.
                if (i % 3 == 0) other.triangle.pixels[i] = other.triangle.pixels[i] == 0 ? 1 : 0;
                if (i % 3 == 1)
                    visibility =
                        visibility == Visibility::lit ? Visibility::shadowed : Visibility::lit;
                if (i % 3 != 2) ++wrong;
            }
            EXPECT_GT(wrong, 100U);
            const ColorCheck colors = check_colors(scene.tracer, other, right);
            EXPECT_EQ(colors.unpredicted, 0U);
            const auto as_shown = [&](const ColorCheck& check, std::size_t i) {
                return check.verdict.pixels[i] == ColorVerdict::as_shown;
            };
            Frame brighter = right;
            for (glm::vec3& color : brighter.color.pixels) color += 0.5F;
            const ColorCheck bright = check_colors(scene.tracer, other, brighter);
            for (std::size_t i = 0; i < other.visibility.pixels.size(); ++i) {
                if (other.visibility.pixels[i] == Visibility::background) continue;
                EXPECT_EQ(as_shown(colors, i), i % 3 != 2) << i;
                EXPECT_FALSE(as_shown(bright, i)) << i;
            }
        }
    }
}

/// A pixel that claims light must be lit, and one that claims shadow must not.
TEST(Colors, of_the_other_visibility_than_is_claimed_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_sphere", 64);
    for (const char* name : {"bump_tangent_space", "bump_three_pass"}) {
        SCOPED_TRACE(name);
        Frame frame = render(*find_technique(name), scene.scene, scene.plan, gpu);
        for (Visibility& claim : frame.claim.pixels)
            if (claim == Visibility::lit) claim = Visibility::shadowed;
        const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
        int bright = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                if (scene.truth.visibility.at(x, y) != Visibility::lit) continue;
                const ColorAccount account =
                    account_for_color(scene.tracer, scene.truth, frame, x, y);
                EXPECT_EQ(account.verdict, colors.verdict.at(x, y));
                if (account.truth.diffuse < 0.1) continue;
                ++bright;
                EXPECT_EQ(account.verdict, ColorVerdict::unexplained) << x << ' ' << y;
            }
        EXPECT_GT(bright, 100);
    }
}

TEST(Colors, tell_how_wide_their_bounds_are_and_which_needed_the_rasterizers_spread) {
    const ColorCheck floats = colors_of("bumpy_torus", "bump_tangent_space");
    const ColorCheck bytes = colors_of("bumpy_torus", "bump_one_pass");
    EXPECT_LT(floats.bound_width.median, 0.01); // nothing but the roundings of floats
    EXPECT_LE(floats.bound_width.widest, 2.001);
    EXPECT_GT(bytes.bound_width.median, 1); // half a step to either side at the least
    EXPECT_LT(bytes.bound_width.median, bytes.bound_width.percentile999);
    EXPECT_LE(bytes.bound_width.percentile999, bytes.bound_width.widest);
    EXPECT_GT(floats.interpolated, 0U);
    EXPECT_LT(floats.interpolated, floats.judged / 4);
}

TEST(Colors, are_the_same_for_any_number_of_threads) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_torus", 256);
    const Frame frame = render(*find_technique("bump_one_pass"), scene.scene, scene.plan, gpu);
    const ColorCheck many = check_colors(scene.tracer, scene.truth, frame);
    const Tracer tracer(scene.scene, 1);
    const ColorCheck one = check_colors(tracer, scene.truth, frame);
    EXPECT_EQ(one.error.pixels, many.error.pixels);
    EXPECT_EQ(one.verdict.pixels, many.verdict.pixels);
    EXPECT_EQ(one.rmse, many.rmse);
    EXPECT_EQ(one.beyond_by, many.beyond_by);
    EXPECT_EQ(one.interpolated, many.interpolated);
}

class FaultInLighting : public testing::TestWithParam<tests::LightingFault> {};

/// Its right twin is predicted to the last pixel (ColorsOfScene).
TEST_P(FaultInLighting, is_caught_on_a_bundled_scene) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced(GetParam().scene, 256);
    const Comparison comparison =
        tests::compared(scene, tests::draw_faulty(gpu, scene.scene, scene.plan, GetParam()));
    EXPECT_GT(comparison.colors->unpredicted, 100U);
    EXPECT_EQ(judge(scene.scene, {}, {}, comparison), Verdict::unexplained);
}

INSTANTIATE_TEST_SUITE_P(Injected, FaultInLighting,
                         testing::ValuesIn(tests::lighting_faults().begin(),
                                           tests::lighting_faults().end()),
                         [](const auto& fault) { return std::string(fault.param.name); });

} // namespace
} // namespace shadowproof
