// A cause is what mends the pixel once it is lifted.
#include "compare/stencil/counterfactual.h"
#include "compare/verdict.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::compared;
using tests::pixels_of;
using tests::TracedScene;
using L = Limitation;

TEST(Counterfactual, the_first_that_mends_alone_is_the_cause) {
    const Limitations has = L::near_clip | L::eye_start | L::counter | L::open_mesh;
    const auto any_of = [](Limitations those) {
        return [those](Limitations lifted) { return !(lifted & those).empty(); };
    };
    EXPECT_EQ(needed_lifts(has, any_of(L::counter | L::eye_start)), Limitations(L::eye_start));
    EXPECT_EQ(needed_lifts(has, any_of(L::open_mesh)), Limitations(L::open_mesh));
    EXPECT_EQ(needed_lifts(has, any_of(L::far_clip)), std::nullopt) << "which it does not have";
}

TEST(Counterfactual, where_none_mends_alone_it_is_the_fewest_that_do) {
    const Limitations has = L::near_clip | L::eye_start | L::counter | L::open_mesh;
    const auto all_of = [](Limitations those) {
        return [those](Limitations lifted) { return lifted.contains(those); };
    };
    EXPECT_EQ(needed_lifts(has, all_of(L::eye_start | L::open_mesh)), L::eye_start | L::open_mesh);
    EXPECT_EQ(needed_lifts(has, all_of(has)), has);
    EXPECT_EQ(decisive_cause(L::eye_start | L::open_mesh), Cause::eye_inside);
    int asked = 0;
    EXPECT_EQ(needed_lifts(has,
                           [&](Limitations) {
                               ++asked;
                               return false;
                           }),
              std::nullopt);
    EXPECT_EQ(asked, 15);
}

/// Alpha aside, which comes before what changes how many of a closed caster's triangles count.
TEST(Counterfactual, limitations_come_in_the_order_of_their_causes) {
    std::vector<Cause> causes;
    for (int i = 0; i < limitation_count; ++i) causes.push_back(cause_of(static_cast<L>(i)));
    EXPECT_EQ(std::ranges::find(causes, Cause::alpha) + 1,
              std::ranges::find(causes, Cause::parity));
    std::erase(causes, Cause::alpha);
    EXPECT_TRUE(std::ranges::is_sorted(causes));
}

/// A technique on a scene, and what must be lifted of it there.
struct Blamed {
    std::string scene;
    std::string technique;
    Limitation limitation;
};

class CounterfactualOfCell : public testing::TestWithParam<Blamed> {};

/// Whether a claim that follows from what is counted without some limitations is the truth.
bool mends(const TracedScene& traced, const Prediction& prediction, Limitations lifted, int x,
           int y) {
    const std::int64_t count = prediction.count_without(lifted, x, y);
    const bool lit = stored(count, prediction.without(lifted).counting) == 0;
    return lit == (traced.truth.visibility.at(x, y) == Visibility::lit);
}

TEST_P(CounterfactualOfCell, its_cause_mends_each_of_its_pixels_and_none_before_it_does) {
    Scene scene = tests::load_named(GetParam().scene);
    scene.camera.width = scene.camera.height = 150;
    const TracedScene traced(std::move(scene));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame =
        render(*find_technique(GetParam().technique), traced.scene, traced.plan, gpu);
    const Prediction prediction = prediction_of(traced, frame);
    const Comparison comparison = compared(traced, frame);
    const Cause cause = cause_of(GetParam().limitation);
    EXPECT_GT(pixels_of(comparison, cause), 20U);
    EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U);
    std::uint64_t wrong = 0;
    std::uint64_t at_centre = 0;
    for (int y = 0; y < frame.claim.height; ++y)
        for (int x = 0; x < frame.claim.width; ++x) {
            if (comparison.cause.at(x, y) != static_cast<std::uint8_t>(cause)) continue;
            // Others are explained by what is next to them.
            if (stored(prediction.counts().at(x, y), frame.counted->counting) !=
                    frame.counted->counter.at(x, y) ||
                traced.truth.triangle.at(x, y) != frame.triangle.at(x, y))
                continue;
            ++at_centre;
            EXPECT_TRUE(comparison.also.pixels.empty() || comparison.also.at(x, y) == 0);
            wrong += mends(traced, prediction, GetParam().limitation, x, y) ? 0U : 1U;
            for (const Limitation other : listed(prediction.limitations()))
                if (other < GetParam().limitation)
                    wrong += mends(traced, prediction, other, x, y) ? 1U : 0U;
        }
    EXPECT_GT(at_centre, 20U);
    EXPECT_EQ(wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(Bundled, CounterfactualOfCell,
                         testing::Values(Blamed{"near_plane", "zpass", L::near_clip},
                                         Blamed{"near_cap_some", "zpass_eye_count", L::near_clip},
                                         Blamed{"far_plane", "zfail", L::far_clip},
                                         Blamed{"eye_inside", "zpass", L::eye_start},
                                         Blamed{"seen_shadow", "invert", L::eye_start},
                                         Blamed{"long_shadow", "zfail_truncated", L::extrusion},
                                         Blamed{"far_plane", "zfail_no_dark_cap", L::caps},
                                         Blamed{"ordinary", "zfail_no_light_cap", L::caps},
                                         Blamed{"ordinary", "zfail_saturate", L::counter},
                                         Blamed{"nested", "zfail_reversed", L::counter},
                                         Blamed{"overlapping", "invert", L::parity},
                                         Blamed{"open_lid", "zfail_reversed", L::open_mesh},
                                         Blamed{"inverted", "zpass", L::open_mesh},
                                         Blamed{"light_inside", "zpass", L::light_inside}),
                         [](const auto& blamed) {
                             return blamed.param.scene + "_" + blamed.param.technique;
                         });

/// The eye and all of the near plane under a wide canopy, half of the near plane under a narrow one
/// as well: where the floor is in their shadows, beside them, or in both, other crossings are lost.
TEST(Counterfactual, eye_and_near_plane_are_told_apart_by_what_a_pixel_lost) {
    Scene scene = tests::empty_scene();
    scene.lights[0].position = {0.31, 12.17, 0.73};
    tests::look_at(scene.camera, {0.013, 1.1, 0.021}, {0.02, 0.31, -3});
    scene.camera.near = 1;
    scene.camera.width = scene.camera.height = 150;
    tests::add_rectangle(scene, {-30, 0, 30}, {30, 0, 30}, {30, 0, -30}, {-30, 0, -30});
    tests::add_box(scene, {-1.7F, 4, -2.3F}, {1.6F, 4.1F, 1.9F});      // the canopy
    tests::add_box(scene, {0.211F, 2.9F, -1.9F}, {1.31F, 3, -0.413F}); // over the near plane
    const TracedScene traced(std::move(scene));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zpass"), traced.scene, traced.plan, gpu);
    const Comparison comparison = compared(traced, frame);
    const Prediction prediction = prediction_of(traced, frame);
    ASSERT_EQ(traced.depths.at_eye, 1);
    EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U);
    std::map<std::pair<Cause, bool>, int> found; // by cause, and whether it is one of several
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 150; ++x) {
            const std::uint8_t cause = comparison.cause.at(x, y);
            if (cause != static_cast<std::uint8_t>(Cause::near_plane) &&
                cause != static_cast<std::uint8_t>(Cause::eye_inside))
                continue;
            const int surface = traced.depths.at_surface.at(x, y);
            const int near = traced.depths.at_near.at(x, y);
            const bool is_lit = traced.truth.visibility.at(x, y) == Visibility::lit;
            if (stored(prediction.counts().at(x, y), frame.counted->counting) !=
                frame.counted->counter.at(x, y))
                continue;
            const bool near_mends = (surface - 1 == 0) == is_lit;
            const bool eye_mends = (surface - near + 1 == 0) == is_lit;
            const bool both = !near_mends && !eye_mends;
            const Cause expected = near_mends || both ? Cause::near_plane : Cause::eye_inside;
            EXPECT_EQ(cause, static_cast<std::uint8_t>(expected)) << x << ", " << y;
            CauseSet also;
            if (both) also.add(Cause::eye_inside);
            EXPECT_EQ(comparison.also.pixels.empty() ? 0U : comparison.also.at(x, y), also.bits());
            ++found[{expected, both}];
        }
    EXPECT_GT((found[{Cause::near_plane, false}]), 20);
    EXPECT_GT((found[{Cause::eye_inside, false}]), 20);
    EXPECT_GT((found[{Cause::near_plane, true}]), 20);
    EXPECT_EQ(comparison.several, static_cast<std::uint64_t>(found[{Cause::near_plane, true}]));
}

/// Outside of the ball it is dark, up to the far plane and beyond: zfail lacks the ball's shadow,
/// and would lose it past the far plane if it had it.
TEST(Counterfactual, a_light_inside_needs_the_far_plane_lifted_as_well_where_that_clips) {
    Scene scene = tests::load_named("light_inside");
    scene.camera.width = scene.camera.height = 100;
    const TracedScene traced(std::move(scene));
    Gpu gpu(GlPlatform::osmesa);
    const Comparison zfail = compared(traced, "zfail", gpu);
    const std::uint64_t far = pixels_of(zfail, Cause::far_plane);
    EXPECT_GT(far, 500U);
    EXPECT_EQ(zfail.several, far);
    EXPECT_EQ(pixels_of(zfail, Cause::light_inside), 0U);
    CauseSet also;
    also.add(Cause::light_inside);
    for (std::size_t i = 0; i < zfail.cause.pixels.size(); ++i)
        if (zfail.cause.pixels[i] == static_cast<std::uint8_t>(Cause::far_plane)) {
            EXPECT_EQ(zfail.also.pixels[i], also.bits());
        }
    const Comparison zpass = compared(traced, "zpass", gpu);
    EXPECT_EQ(pixels_of(zpass, Cause::light_inside), far);
    EXPECT_EQ(zpass.several, 0U);
    EXPECT_EQ(pixels_of(zpass, Cause::open_mesh), 0U);
}

/// What a technique has not got, it is not blamed for, and what does not mend is no excuse.
/// The line of sight of the middle pixel leads where the sun's volumes end, in a point. No dark cap
/// covers it, and so none is missing there.
TEST(Counterfactual, of_a_sun_along_a_line_of_sight_misses_no_dark_cap) {
    Scene scene = tests::empty_scene();
    scene.camera.width = 33;
    scene.camera.height = 17;
    scene.lights[0].kind = Light::Kind::directional;
    scene.lights[0].direction = {0, 0, -1};
    tests::add_rectangle(scene, {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
    // Behind the eye, turned away from the sun: no volume is its own.
    tests::add_rectangle(scene, {-9, 9, 6}, {9, 9, 6}, {9, -9, 6}, {-9, -9, 6});
    const TracedScene traced(scene);
    ASSERT_EQ(traced.truth.visibility.at(16, 8), Visibility::shadowed);
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!can_draw(technique, scene)) continue;
        const Frame frame = render(technique, scene, traced.plan, gpu);
        if (!frame.counted) continue;
        const Comparison comparison = compared(traced, frame);
        EXPECT_EQ(pixels_of(comparison, Cause::cap), 0U) << technique.name;
        const Verdict verdict = judge(scene, known_on(scene, frame, technique.fails_at),
                                      technique.by_nature, comparison);
        EXPECT_TRUE(verdict == Verdict::agrees || verdict == Verdict::fails_as_predicted)
            << technique.name << " " << name_of(verdict);
    }
}

TEST(Counterfactual, a_wrong_claim_that_nothing_mends_is_unexplained) {
    Scene scene = tests::load_named("near_plane");
    scene.camera.width = scene.camera.height = 60;
    const TracedScene traced(std::move(scene));
    Gpu gpu(GlPlatform::osmesa);
    Frame frame = render(*find_technique("zpass"), traced.scene, traced.plan, gpu);
    EXPECT_GT(pixels_of(compared(traced, frame), Cause::near_plane), 500U);
    // The very counters, told as of a technique that makes up for the near plane.
    frame.counted->counting.start = Counting::Start::near_plane;
    const Comparison capped = compared(traced, frame);
    EXPECT_EQ(pixels_of(capped, Cause::near_plane), 0U);
    EXPECT_GT(pixels_of(capped, Cause::unexplained), 500U);
}

} // namespace
} // namespace shadowproof
