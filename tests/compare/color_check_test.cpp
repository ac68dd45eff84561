// Colours are judged by intervals that are derived, pixel by pixel: what a technique computes is
// foreseen, what it rounds is within its bound, and what nobody foresees is told.
#include "compare/verdict.h"
#include "scenes/catalog.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/faulty_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::TracedScene;

std::vector<std::string> bump_lit_scenes() {
    std::vector<std::string> names;
    for (const BundledScene& bundled : bundled_scenes())
        if (is_bump_lit(load_scene(std::string(bundled.name), {})))
            names.emplace_back(bundled.name);
    return names;
}

/// Kept for all tests that ask for it.
const TracedScene& traced(const std::string& name, int side) {
    static std::map<std::pair<std::string, int>, std::unique_ptr<TracedScene>> scenes;
    std::unique_ptr<TracedScene>& scene = scenes[{name, side}];
    if (!scene) {
        SceneRequest request;
        request.width = side;
        request.height = side;
        scene = std::make_unique<TracedScene>(load_scene(name, request));
    }
    return *scene;
}

std::vector<const Technique*> techniques_for(const Scene& scene) {
    std::vector<const Technique*> techniques;
    for (const Technique& technique : all_techniques())
        if (technique.needs_bump_maps && suits(technique, scene)) techniques.push_back(&technique);
    return techniques;
}

ColorCheck colors_of(const TracedScene& scene, const Technique& technique,
                     const LightingSettings& settings, Gpu& gpu) {
    Plan plan = scene.plan;
    plan.lighting = settings;
    return check_colors(scene.tracer, scene.truth, render(technique, scene.scene, plan, gpu));
}

class ColorsOfScene : public testing::TestWithParam<std::string> {
protected:
    Gpu gpu_{GlPlatform::osmesa};
};

TEST_P(ColorsOfScene, every_pixel_of_every_technique_is_foreseen_and_floats_are_within_a_step) {
    const TracedScene& scene = traced(GetParam(), 512);
    for (const Technique* technique : techniques_for(scene.scene)) {
        SCOPED_TRACE(technique->name);
        const Frame frame = render(*technique, scene.scene, scene.plan, gpu_);
        const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
        EXPECT_EQ(colors.unforeseen, 0U)
            << "first " << colors.first_unforeseen_x << "," << colors.first_unforeseen_y;
        EXPECT_GT(colors.judged, 100000U);
        if (frame.color_model.arithmetic != ColorModel::Arithmetic::floating) {
            EXPECT_GT(colors.largest, 1);
            continue;
        }
        EXPECT_LT(colors.largest, 1) << "at " << colors.largest_x << "," << colors.largest_y;
        EXPECT_EQ(colors.beyond, 0U);
    }
}

TEST_P(ColorsOfScene, every_pixel_is_foreseen_under_every_setting) {
    const TracedScene& scene = traced(GetParam(), 160);
    const bool heights =
        std::any_of(scene.scene.materials.begin(), scene.scene.materials.end(),
                    [](const Material& material) { return material.bump == Bump::height_field; });
    std::vector<LightingSettings> all;
    for (const Normalisation normalisation : all_normalisations)
        all.push_back({.normalisation = normalisation});
    for (const BumpForm form : all_bump_forms)
        if (form != BumpForm::height_field || heights) all.push_back({.bump_form = form});
    for (const Technique* technique : techniques_for(scene.scene))
        for (const LightingSettings& settings : all) {
            SCOPED_TRACE(technique->name);
            SCOPED_TRACE(settings.normalisation ? name_of(*settings.normalisation)
                                                : name_of(*settings.bump_form));
            const ColorCheck colors = colors_of(scene, *technique, settings, gpu_);
            EXPECT_EQ(colors.unforeseen, 0U)
                << "first " << colors.first_unforeseen_x << "," << colors.first_unforeseen_y;
        }
}

INSTANTIATE_TEST_SUITE_P(BumpLit, ColorsOfScene, testing::ValuesIn(bump_lit_scenes()),
                         [](const auto& instance) { return instance.param; });

/// Of a technique at its own settings on a bundled scene.
ColorCheck colors_of(const char* scene, const char* technique) {
    Gpu gpu(GlPlatform::osmesa);
    return colors_of(traced(scene, 256), *find_technique(technique), {}, gpu);
}

TEST(Colors, one_pass_dims_highlights_near_the_terminator_and_three_passes_do_not) {
    EXPECT_GT(colors_of("terminator_highlight", "bump_one_pass").beyond, 1000U);
    EXPECT_EQ(colors_of("terminator_highlight", "bump_three_pass").beyond, 0U);
}

TEST(Colors, three_passes_clamp_bright_light_before_the_decal_and_one_pass_hardly_does) {
    const ColorCheck three = colors_of("bright_light", "bump_three_pass");
    const ColorCheck one = colors_of("bright_light", "bump_one_pass");
    EXPECT_GT(three.beyond, 100 * one.beyond);
}

TEST(Colors, a_pixel_of_the_terminator_owes_most_of_its_difference_to_the_dimmed_highlight) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("terminator_highlight", 256);
    const Frame frame = render(*find_technique("bump_one_pass"), scene.scene, scene.plan, gpu);
    const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
    const ColorAccount account =
        account_for_color(scene.tracer, scene.truth, frame, colors.largest_x, colors.largest_y);
    EXPECT_EQ(account.verdict, ColorVerdict::beyond);
    const auto heaviest = std::max_element(account.weights.begin(), account.weights.end());
    EXPECT_EQ(heaviest - account.weights.begin(),
              static_cast<std::ptrdiff_t>(ColorTerm::self_shadow));
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
}

class FaultInLighting : public testing::TestWithParam<tests::LightingFault> {};

/// Its right twin is foreseen to the last pixel (ColorsOfScene).
TEST_P(FaultInLighting, is_caught_on_a_bundled_scene) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced(GetParam().scene, 256);
    const Comparison comparison =
        tests::compared(scene, tests::draw_faulty(gpu, scene.scene, scene.plan, GetParam()));
    EXPECT_GT(comparison.colors->unforeseen, 500U);
    EXPECT_EQ(judge(scene.scene, {}, {}, comparison), Verdict::unexplained);
}

INSTANTIATE_TEST_SUITE_P(Injected, FaultInLighting,
                         testing::ValuesIn(tests::lighting_faults().begin(),
                                           tests::lighting_faults().end()),
                         [](const auto& fault) { return std::string(fault.param.name); });

} // namespace
} // namespace shadowproof
