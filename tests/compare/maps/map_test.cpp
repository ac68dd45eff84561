// Shadow maps against the truth: every texel is predicted, causes follow the settings, and what is
// off by more than the bounds is not explained.
#include "compare/evidence.h"
#include "compare/maps/lookup.h"
#include "compare/verdict.h"
#include "scenes/error.h"
#include "tests/compare/maps/drawn_map.h"
#include "tests/scenes/over_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

using tests::all_texels;
using tests::compared;
using tests::drawn;
using tests::load_named;
using tests::pixels_of;
using tests::small;
using tests::texels_not_shown;
using tests::TracedScene;

struct Setting {
    std::string name;
    MapSettings settings;
};

/// With a bias of a thousandth of the map's reach: one that is lost in roundings would leave either
/// answer to them.
std::vector<Setting> all_settings(const Scene& scene) {
    const bool is_sun = chosen_light(scene).kind == Light::Kind::directional;
    const double reach =
        with_settings(is_sun ? sun_model() : MapModel{}, {}, scene).far * scene.unit;
    std::vector<Setting> all;
    for (const MapValue value : all_map_values) {
        if (is_sun && value == MapValue::distance) continue; // it has depths whatever is asked
        for (const MapFormat format : all_map_formats)
            for (const MapCulling culling : all_map_cullings)
                all.push_back({std::string(name_of(value)) + "_" + std::string(name_of(format)) +
                                   "_culling_" + std::string(name_of(culling)),
                               {.size = 96,
                                .bias = 0.001 * reach,
                                .value = value,
                                .format = format,
                                .culling = culling}});
    }
    for (const MapFormat format : all_map_formats)
        all.push_back({"depth_" + std::string(name_of(format)) + "_offset",
                       {.size = 96,
                        .bias = 0.001 * reach,
                        .slope_bias = 1.1,
                        .offset_units = 4,
                        .value = MapValue::depth,
                        .format = format}});
    return all;
}

/// Of techniques that filter.
std::vector<Setting> filter_settings(const Scene& scene, bool is_cube) {
    std::vector<Setting> all;
    for (const MapAverage average : all_map_averages)
        for (const int filter : {1, 2, 5, largest_map_filter})
            for (const MapEdges edges : all_map_edges) {
                if (!is_cube && edges == MapEdges::seamless) continue;
                Setting setting = all_settings(scene).front();
                setting.name = fmt::format("{}_of_{}_{}", name_of(average), filter, name_of(edges));
                setting.settings.filter = filter;
                setting.settings.average = average;
                setting.settings.edges = edges;
                all.push_back(setting);
            }
    return all;
}

/// Whatever the technique has a choice of.
std::vector<Setting> settings_of(const std::string& technique, const Scene& scene) {
    if (technique.ends_with("_pcf")) return filter_settings(scene, technique == "cube_map_pcf");
    std::vector<Setting> all = all_settings(scene);
    if (technique == "spot_map_dual_texture") // it has its own value and format
        std::erase_if(all, [](const Setting& each) {
            return each.settings.value != MapValue::depth || each.settings.format != MapFormat::d24;
        });
    return all;
}

class MapOfScene : public testing::TestWithParam<std::string> {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene traced{small(GetParam())};

    std::vector<std::string> techniques() const {
        std::vector<std::string> names;
        for (const char* name :
             {"cube_map_six_pass", "cube_map_geometry_shader", "cube_map_pcf", "spot_map",
              "spot_map_pcf", "spot_map_stencil", "spot_map_dual_texture", "sun_map"})
            if (suits(*find_technique(name), traced.scene)) names.emplace_back(name);
        return names;
    }
};

TEST_P(MapOfScene, every_texel_is_as_predicted) {
    for (const std::string& technique : techniques()) {
        if (technique.ends_with("_pcf")) continue; // it draws its map as the others do
        EXPECT_EQ(texels_not_shown(traced, drawn(gpu, traced, technique, {.size = 256})), 0U)
            << technique;
    }
}

TEST_P(MapOfScene, no_setting_leaves_a_pixel_unexplained) {
    for (const std::string& technique : techniques()) {
        if (technique == "cube_map_geometry_shader") continue; // its maps are those of six passes
        for (const Setting& setting : settings_of(technique, traced.scene)) {
            const Frame frame = drawn(gpu, traced, technique, setting.settings);
            const Comparison comparison = compared(traced, frame);
            EXPECT_TRUE(is_explained(comparison)) << technique << " " << setting.name;
            // Beside those that pixels ask; filtered maps are drawn as the others are.
            if (frame.mapped->model.filter > 0) continue;
            EXPECT_EQ(texels_not_shown(traced, frame), 0U) << technique << " " << setting.name;
            EXPECT_LT(comparison.evidence.in_band, comparison.cause.pixels.size() / 50)
                << technique << " " << setting.name;
        }
    }
}

SHADOWPROOF_OVER_SCENES(MapOfScene, tests::bundled_names());

class Maps : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene ordinary{small("ordinary")};

    Comparison judged(const MapSettings& settings, const std::string& name = "cube_map_six_pass") {
        return compared(ordinary, drawn(gpu, ordinary, name, settings));
    }
};

/// A technique on the scene that it suits.
struct OnScene {
    const char* technique;
    const char* scene;
};

class MapOfEachKind : public testing::TestWithParam<OnScene> {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene traced{small(GetParam().scene)};

    Comparison judged(const MapSettings& settings) {
        return compared(traced, drawn(gpu, traced, GetParam().technique, settings));
    }
};

TEST_P(MapOfEachKind, errs_less_the_more_texels_it_has) {
    std::uint64_t before = traced.truth.visibility.pixels.size();
    for (const int size : {16, 64, 256, 1024}) {
        const std::uint64_t wrong = judged({.size = size, .bias = 0.05}).differing;
        EXPECT_LT(wrong, before) << size;
        before = wrong;
    }
}

TEST_P(MapOfEachKind, shows_acne_alone_without_bias_and_leaks_alone_with_a_large_one) {
    const Comparison none = judged({.bias = 0});
    EXPECT_GT(pixels_of(none, Cause::acne), 100U);
    EXPECT_EQ(pixels_of(none, Cause::leak), 0U);
    const Comparison large = judged({.bias = 0.6});
    EXPECT_EQ(pixels_of(large, Cause::acne), 0U);
    EXPECT_GT(pixels_of(large, Cause::leak), 10U);
    EXPECT_TRUE(is_explained(none));
    EXPECT_TRUE(is_explained(large));
}

INSTANTIATE_TEST_SUITE_P(Maps, MapOfEachKind,
                         testing::Values(OnScene{"cube_map_six_pass", "ordinary"},
                                         OnScene{"sun_map", "sun"}),
                         [](const auto& of) { return std::string(of.param.technique); });

class MapErrors : public MapOfEachKind {};

TEST_P(MapErrors, add_up_to_less_the_more_texels_there_are) {
    double before = std::numeric_limits<double>::infinity();
    for (const int size : {16, 64, 256, 1024}) {
        const Frame frame = drawn(gpu, traced, GetParam().technique, {.size = size, .bias = 0.05});
        const Comparison comparison = compared(traced, frame);
        const double wrong = comparison.shares ? comparison.shares->wrongness
                                               : static_cast<double>(comparison.differing);
        EXPECT_LT(wrong, before) << size;
        before = wrong;
    }
}

INSTANTIATE_TEST_SUITE_P(Maps, MapErrors,
                         testing::Values(OnScene{"spot_map", "spot"},
                                         OnScene{"spot_map_pcf", "spot"},
                                         OnScene{"cube_map_pcf", "ordinary"}),
                         [](const auto& of) { return std::string(of.param.technique); });

TEST_F(Maps, without_acne_have_bias_enough_to_mend_it) {
    EXPECT_GT(pixels_of(judged({.size = 128, .bias = 0.01}), Cause::acne), 0U);
    EXPECT_EQ(pixels_of(judged({.size = 128, .bias = 1}), Cause::acne), 0U);
}

TEST_F(Maps, show_range_where_the_far_plane_cuts_the_scene_and_nowhere_else) {
    const Comparison all = judged({});
    EXPECT_EQ(pixels_of(all, Cause::range), 0U);
    const Comparison cut = judged({.bias = 0.02, .far = 3});
    EXPECT_GT(pixels_of(cut, Cause::range), 100U);
    EXPECT_TRUE(is_explained(cut));
    EXPECT_EQ(judge(ordinary.scene, find_technique("cube_map_six_pass")->fails_at,
                    find_technique("cube_map_six_pass")->by_nature, cut),
              Verdict::defect);
}

/// A pixel's cause names what mends it: drawn again with a map that reaches further, those that
/// have `range` alone are right, and those that have another cause with it are not.
TEST_F(Maps, that_reach_further_mend_what_range_alone_is_the_cause_of) {
    const TracedScene scene(small("light_range"));
    const auto judge = [&](std::optional<double> far) {
        return compared(scene, drawn(gpu, scene, "cube_map_six_pass", {.size = 24, .far = far}));
    };
    const Comparison cut = judge({});
    const Comparison whole = judge(100);
    int alone = 0;
    int with_others = 0;
    for (std::size_t i = 0; i < cut.cause.pixels.size(); ++i) {
        if (cut.cause.pixels[i] != static_cast<std::uint8_t>(Cause::range)) continue;
        const bool needs_more = cut.also.pixels[i] != 0;
        (needs_more ? with_others : alone) += 1;
        EXPECT_EQ(whole.cause.pixels[i] == no_difference, !needs_more) << i;
    }
    EXPECT_GT(alone, 1000);
    EXPECT_GT(with_others, 10);
    EXPECT_EQ(pixels_of(whole, Cause::range), 0U);
}

/// Wires before the near plane are lost whichever sides are culled.
TEST_F(Maps, that_cull_name_open_meshes_only_where_drawing_both_sides_mends_a_pixel) {
    const TracedScene wires(small("near_light"));
    const TracedScene lid(small("open_lid"));
    for (const MapCulling culling : {MapCulling::front, MapCulling::back}) {
        const MapSettings settings{.size = 64, .culling = culling};
        const Comparison before_near =
            compared(wires, drawn(gpu, wires, "cube_map_six_pass", settings));
        EXPECT_GT(pixels_of(before_near, Cause::range), 100U) << name_of(culling);
        EXPECT_EQ(pixels_of(before_near, Cause::open_mesh), 0U) << name_of(culling);
        EXPECT_TRUE(is_explained(before_near));
    }
    const Comparison open = compared(
        lid, drawn(gpu, lid, "cube_map_six_pass", {.size = 64, .culling = MapCulling::back}));
    const Comparison both = compared(lid, drawn(gpu, lid, "cube_map_six_pass", {.size = 64}));
    for (std::size_t i = 0; i < open.cause.pixels.size(); ++i) {
        const bool is_open = open.cause.pixels[i] == static_cast<std::uint8_t>(Cause::open_mesh);
        if (!is_open || open.also.pixels[i] != 0) continue;
        EXPECT_EQ(both.cause.pixels[i], no_difference) << i;
    }
}

TEST_F(Maps, with_a_bias_below_zero_are_wrong_by_acne) {
    const Comparison comparison = judged({.bias = -0.1});
    EXPECT_GT(pixels_of(comparison, Cause::acne), 1000U);
    for (std::size_t i = 0; i < comparison.cause.pixels.size(); ++i)
        if (comparison.cause.pixels[i] == static_cast<std::uint8_t>(Cause::resolution)) {
            EXPECT_EQ(ordinary.truth.visibility.pixels[i], Visibility::shadowed) << i;
        }
    EXPECT_TRUE(is_explained(comparison));
}

TEST_F(Maps, of_one_pass_are_those_of_six) {
    const Frame six = drawn(gpu, ordinary, "cube_map_six_pass", {});
    const Frame one = drawn(gpu, ordinary, "cube_map_geometry_shader", {});
    ASSERT_EQ(six.mapped->faces.size(), 6U);
    for (std::size_t face = 0; face < 6; ++face)
        EXPECT_EQ(six.mapped->faces[face].pixels, one.mapped->faces[face].pixels) << face;
}

TEST_F(Maps, with_a_texel_a_little_beyond_its_bound_are_unexplained_and_within_it_are_not) {
    Frame frame = drawn(gpu, ordinary, "cube_map_six_pass", {.size = 64});
    const std::unique_ptr<LightView> view = light_view(ordinary.scene, *frame.mapped, 8, 0);
    const LightView& light = *view;
    const std::vector<Texel> texels = all_texels(frame.mapped->model);
    const std::vector<FromLight> at_centres = light.trace_without({}, texels);
    int tried = 0;
    for (std::size_t i = 0; i < texels.size(); i += 5) {
        if (at_centres[i].triangle == no_triangle) continue;
        float& stored = frame.mapped->faces[texels[i].face].at(texels[i].x, texels[i].y);
        const float right = stored;
        stored = right * 1.0000001F;
        EXPECT_TRUE(light.shown(texels[i], at_centres[i].triangle)) << i;
        // A sphere as seen from the light turns away within its outermost texels: there a 512th of
        // one may be as much. Elsewhere a fiftieth of the distance is far more than that makes.
        stored = right * 1.02F;
        ++tried;
        EXPECT_FALSE(light.shown(texels[i], at_centres[i].triangle)) << i;
        stored = right;
    }
    EXPECT_GT(tried, 100);
}

class FilteredMap : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene spot{small("spot")};
    MapSettings coarse{.size = 64, .bias = 0.05};

    Frame filtered(int filter, MapAverage average = MapAverage::comparisons) {
        MapSettings settings = coarse;
        settings.filter = filter;
        settings.average = average;
        return drawn(gpu, spot, "spot_map_pcf", settings);
    }
};

/// How many of its comparisons a pixel that is partly lit says to have found light.
std::size_t comparisons_of(const Frame& frame, std::size_t pixel) {
    return static_cast<std::size_t>(
        std::lround(frame.share.pixels[pixel] * frame.mapped->model.asked()));
}

TEST_F(FilteredMap, of_one_texel_is_the_map_without_a_filter) {
    const Frame one = filtered(1);
    EXPECT_EQ(one.claim.pixels, drawn(gpu, spot, "spot_map", coarse).claim.pixels);
    EXPECT_EQ(one.claim.pixels, filtered(1, MapAverage::values).claim.pixels);
    EXPECT_EQ(pixels_of(compared(spot, one), Cause::filter), 0U);
}

TEST_F(FilteredMap, claims_shares_of_light_that_are_those_of_its_texels_comparisons) {
    for (const int filter : {2, 3, 4, 8}) {
        const Frame frame = filtered(filter);
        std::vector<int> pixels(static_cast<std::size_t>(filter * filter), 0);
        for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
            if (frame.claim.pixels[i] == Visibility::partly_lit)
                ++pixels.at(comparisons_of(frame, i));
        EXPECT_EQ(pixels[0], 0);
        // The penumbra is too small for each of 63 shares.
        for (std::size_t share = 1; share < pixels.size() && filter <= 4; ++share)
            EXPECT_GT(pixels[share], 0) << share << " of " << filter;
        const Comparison comparison = compared(spot, frame);
        EXPECT_TRUE(is_explained(comparison)) << filter;
        EXPECT_GT(pixels_of(comparison, Cause::filter), 0U) << filter;
    }
}

TEST_F(FilteredMap, with_one_comparison_more_or_less_is_unexplained) {
    // Window depths are rounded so much that one of 16 comparisons is often a tie.
    coarse.value = MapValue::distance;
    coarse.format = MapFormat::d32f;
    Frame frame = filtered(4);
    std::uint64_t changed = 0;
    for (std::size_t i = 0; i < frame.share.pixels.size(); ++i) {
        if (frame.claim.pixels[i] != Visibility::partly_lit) continue;
        const std::size_t lit = comparisons_of(frame, i);
        frame.share.pixels[i] = static_cast<double>(lit > 1 ? lit - 1 : 2) / 16;
        ++changed;
    }
    const Comparison comparison = compared(spot, frame);
    // A place at the border of a texel, or a comparison that ties, admits another share.
    EXPECT_GT(pixels_of(comparison, Cause::unexplained), changed * 9 / 10);
}

TEST_F(FilteredMap, of_averaged_values_is_not_that_of_averaged_comparisons) {
    const Frame values = filtered(4, MapAverage::values);
    EXPECT_EQ(std::ranges::count(values.claim.pixels, Visibility::partly_lit), 0);
    EXPECT_TRUE(is_explained(compared(spot, values)));
    Frame said = values;
    said.mapped->model.average = MapAverage::comparisons;
    EXPECT_FALSE(is_explained(compared(spot, said)));
    said = filtered(4);
    said.mapped->model.filter = 3;
    EXPECT_FALSE(is_explained(compared(spot, said)));
}

/// What is said of the map, and what is drawn, are two things.
class FaultyMap : public Maps {
protected:
    bool is_caught(const MapSettings& drawn_with, const MapSettings& said) {
        Frame frame = drawn(gpu, ordinary, "cube_map_six_pass", drawn_with);
        frame.mapped->model = with_settings(MapModel{}, said, ordinary.scene);
        return !is_explained(compared(ordinary, frame));
    }
};

TEST_F(FaultyMap, whose_settings_are_others_than_it_says_is_caught) {
    const MapSettings said{.size = 256, .bias = 0.02};
    EXPECT_FALSE(is_caught(said, said));
    const auto changed = [&](auto change) {
        MapSettings other = said;
        change(other);
        return is_caught(other, said);
    };
    EXPECT_TRUE(changed([](MapSettings& s) { s.bias = 0.03; }));
    EXPECT_TRUE(changed([](MapSettings& s) { s.bias = 0; }));
    EXPECT_TRUE(changed([](MapSettings& s) { s.value = MapValue::depth; }));
    EXPECT_TRUE(changed([](MapSettings& s) { s.far = 100; }));
    EXPECT_TRUE(changed([](MapSettings& s) { s.far = 3; }));
    EXPECT_TRUE(changed([](MapSettings& s) { s.culling = MapCulling::front; }));
    EXPECT_TRUE(changed([](MapSettings& s) { s.format = MapFormat::d16; }));
}

TEST_F(Maps, are_not_for_lights_without_a_position) {
    EXPECT_FALSE(suits(*find_technique("cube_map_six_pass"), load_named("sun")));
    EXPECT_FALSE(suits(*find_technique("spot_map"), ordinary.scene));
    EXPECT_FALSE(suits(*find_technique("sun_map"), ordinary.scene));
    EXPECT_TRUE(suits(*find_technique("sun_map"), load_named("sun")));
    EXPECT_TRUE(suits(*find_technique("spot_map"), load_named("spot")));
    const TracedScene sun(small("sun"));
    EXPECT_THROW(drawn(gpu, sun, "cube_map_six_pass", {}), Error);
}

TEST_F(Maps, refuse_planes_that_are_no_range_and_more_texels_than_the_driver_has) {
    EXPECT_THROW(judged({.near = 2, .far = 1}), Error);
    EXPECT_THROW(judged({.near = -1}), Error);
    EXPECT_THROW(judged({.size = 1 << 20}), Error);
}

TEST(Compare, answers_both_ways_only_within_rounding) {
    const MapModel distances{.bias = 0.1, .value = MapValue::distance, .near = 0.01, .far = 8};
    const auto answers = [&](const MapModel& model, double stored, double own) {
        const Answers both = compare(model, stored, own, own);
        EXPECT_EQ(both.shadowed && !both.lit, is_shadowed(model, stored, own) && !both.lit);
        return both;
    };
    // 8 * 0.25 + 0.1 against 2.1, and a thousandth of that more and less.
    const Answers tie = answers(distances, 0.25, 2.1);
    EXPECT_TRUE(tie.shadowed && tie.lit);
    const Answers beyond = answers(distances, 0.25, 2.1 * (1 + 1e-5));
    EXPECT_TRUE(beyond.shadowed && !beyond.lit);
    const Answers before = answers(distances, 0.25, 2.1 * (1 - 1e-5));
    EXPECT_TRUE(!before.shadowed && before.lit);
    MapModel depths = distances;
    depths.value = MapValue::depth;
    // The window depth of 2 between these planes, with a point at 2.1.
    const double stored = 8 / 7.99 * (1 - 0.01 / 2);
    EXPECT_TRUE(answers(depths, stored, 2.1).lit);
    EXPECT_FALSE(answers(depths, stored, 2.2).lit);
    EXPECT_FALSE(answers(depths, stored, 2.0).shadowed);
    // Nothing before the near plane is shadowed.
    EXPECT_FALSE(answers(depths, 0, 0.1).shadowed);
}

} // namespace
} // namespace shadowproof
