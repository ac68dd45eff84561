// Colours are judged by bounds that are derived, pixel by pixel: what a technique rounds is within
// them, what it does otherwise is foreseen, and what nobody foresees is told.
#include "compare/verdict.h"
#include "scenes/catalog.h"
#include "scenes/error.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/faulty_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
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

TracedScene& traced(const std::string& name) {
    static std::map<std::string, std::unique_ptr<TracedScene>> scenes;
    std::unique_ptr<TracedScene>& scene = scenes[name];
    if (!scene) scene = std::make_unique<TracedScene>(load_scene(name, {}));
    return *scene;
}

class ColorsOfScene : public testing::TestWithParam<std::string> {
protected:
    Frame render_with(const Technique& technique, const LightingSettings& settings) {
        const TracedScene& scene = traced(GetParam());
        Plan plan = scene.plan;
        plan.lighting = settings;
        return render(technique, scene.scene, plan, gpu_);
    }
    Comparison compare(const Technique& technique, const LightingSettings& settings = {}) {
        return tests::compared(traced(GetParam()), render_with(technique, settings));
    }

private:
    Gpu gpu_{GlPlatform::osmesa};
};

TEST_P(ColorsOfScene, every_colour_of_every_technique_is_foreseen_by_its_arithmetic) {
    for (const Technique& technique : all_techniques()) {
        if (!technique.needs_bump_maps) continue;
        SCOPED_TRACE(technique.name);
        const Comparison comparison = compare(technique);
        ASSERT_TRUE(comparison.colors.has_value());
        const ColorCheck& colors = *comparison.colors;
        EXPECT_EQ(colors.unforeseen, 0U)
            << "first " << colors.first_unforeseen_x << "," << colors.first_unforeseen_y;
        EXPECT_GT(colors.judged, 10000U);
        std::printf("%-14s %-20s judged %7lu largest %8.4f rmse %7.4f p99.9 %7.4f beyond %lu "
                    "unforeseen %lu moved %lu\n",
                    GetParam().c_str(), std::string(technique.name).c_str(), colors.judged,
                    colors.largest, colors.rmse, colors.percentile999, colors.beyond,
                    colors.unforeseen, colors.moved);
    }
}

class FaultInLighting : public testing::TestWithParam<tests::LightingFault> {
protected:
    Gpu gpu_{GlPlatform::osmesa};
};

TEST_P(FaultInLighting, is_caught_on_a_bundled_scene_and_its_absence_is_not) {
    std::uint64_t unforeseen = 0;
    for (const std::string& name : bump_lit_scenes()) {
        const TracedScene& scene = traced(name);
        const Comparison comparison =
            tests::compared(scene, tests::draw_faulty(gpu_, scene.scene, scene.plan, GetParam()));
        unforeseen += comparison.colors->unforeseen;
        const bool caught = judge(scene.scene, {}, {}, comparison) == Verdict::unexplained;
        EXPECT_EQ(caught, comparison.colors->unforeseen > 0) << name;
    }
    if (GetParam().name == std::string("none"))
        EXPECT_EQ(unforeseen, 0U);
    else
        EXPECT_GT(unforeseen, 100U);
}

INSTANTIATE_TEST_SUITE_P(Injected, FaultInLighting,
                         testing::ValuesIn(tests::lighting_faults().begin(),
                                           tests::lighting_faults().end()),
                         [](const auto& fault) { return std::string(fault.param.name); });

/// Of one technique, all settings of one kind with the other left to it.
std::vector<LightingSettings> all_settings() {
    std::vector<LightingSettings> settings;
    for (const Normalisation normalisation : all_normalisations)
        settings.push_back({normalisation, {}});
    for (const BumpForm form : all_bump_forms) settings.push_back({{}, form});
    return settings;
}

TEST_P(ColorsOfScene, every_colour_is_foreseen_under_every_setting) {
    const bool heights = std::any_of(
        traced(GetParam()).scene.materials.begin(), traced(GetParam()).scene.materials.end(),
        [](const Material& material) { return material.bump == Bump::height_field; });
    for (const Technique& technique : all_techniques()) {
        if (!technique.needs_bump_maps) continue;
        for (const LightingSettings& settings : all_settings()) {
            if (settings.bump_form == BumpForm::height_field && !heights) continue;
            SCOPED_TRACE(technique.name);
            SCOPED_TRACE(settings.normalisation ? name_of(*settings.normalisation)
                                                : name_of(*settings.bump_form));
            const ColorCheck colors = *compare(technique, settings).colors;
            EXPECT_EQ(colors.unforeseen, 0U)
                << "first " << colors.first_unforeseen_x << "," << colors.first_unforeseen_y;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(BumpLit, ColorsOfScene, testing::ValuesIn(bump_lit_scenes()),
                         [](const auto& instance) { return instance.param; });

} // namespace
} // namespace shadowproof
