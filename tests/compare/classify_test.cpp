#include "compare/driver/error_bounds.h"
#include "compare/verdict.h"
#include "raster/technique.h"
#include "reference/predict/region_ledger.h"
#include "reference/trace/faces.h"
#include "scenes/camera.h"
#include "scenes/mesh/topology.h"
#include "tests/compare/traced_bundled.h"
#include "tests/raster/faulty_techniques.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

namespace shadowproof {
namespace {

using tests::bundled_names;
using tests::compared;
using tests::pixels_of;
using tests::traced_bundled;
using tests::TracedScene;

class Classify : public testing::Test {
protected:
    Comparison compare(const std::string& name, const Technique& technique) {
        return compared(traced_bundled(name), technique, gpu_);
    }
    Comparison compare(const std::string& name, const std::string& technique) {
        return compare(name, *find_technique(technique));
    }

    Gpu& gpu() { return gpu_; }

private:
    Gpu gpu_{GlPlatform::osmesa};
};

/// Differing pixels whose cause is none of these.
std::uint64_t pixels_beyond(const Comparison& comparison, std::initializer_list<Cause> causes) {
    std::uint64_t beyond = comparison.differing;
    for (const Cause cause : causes) beyond -= pixels_of(comparison, cause);
    return beyond;
}

/// All techniques on one bundled scene: a test each, so that none takes long.
class ClassifyScene : public Classify, public testing::WithParamInterface<std::string> {};

constexpr const char* robust[] = {
    "zfail_clamp",        "zfail_infinite",         "zfail_reversed",
    "zfail_half_edge",    "zfail_degenerate_quads", "zfail_geometry_shader",
    "zfail_per_triangle", "zpass_capped",           "auto"};

/// What was predicted is read back at every pixel outside the band.
void expect_explained(const Comparison& comparison) {
    EXPECT_EQ(comparison.evidence.unexplained, 0U)
        << "first at " << comparison.evidence.first_x << "," << comparison.evidence.first_y;
    EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U);
    EXPECT_EQ(comparison.evidence.equal + comparison.evidence.in_band,
              comparison.cause.pixels.size());
}

/// Whether a surface or a volume's face ends within a pixel of this one's centre, or one cuts the
/// other; or a face meets the surface, the near or the far plane there, as nearly as depths tell. A
/// triangle's own cap, which is drawn as the triangle is, does not count.
bool has_outline_or_tie(const TracedScene& scene, const Prediction& prediction,
                        const DepthModel& model, int x, int y) {
    const Camera& camera = scene.scene.camera;
    const std::uint32_t seen = scene.truth.triangle.at(x, y);
    RegionLedger region =
        prediction.volumes().ledger(corner_lines(camera, x - 1, y - 1, x + 2, y + 2));
    std::vector<Crossing> here, there;
    const glm::dvec3 centre = line_of_sight(camera, x + 0.5, y + 0.5);
    region.crossings(centre, here);
    const auto ties = [&](double depth, const Crossing& crossing) {
        return std::abs(crossing.depth - depth) <=
               depth_error(scene.scene, model, camera.eye + depth * centre);
    };
    const double surface = seen == no_triangle ? std::numeric_limits<double>::infinity()
                                               : depth_on_triangle(scene.scene, seen, centre);
    for (const Crossing& crossing : here) {
        const bool is_own_cap =
            crossing.part == Crossing::Part::light_cap && crossing.triangle == seen;
        if (ties(camera.near, crossing) || ties(camera.far, crossing)) return true;
        if (std::isfinite(surface) && !is_own_cap && ties(surface, crossing)) return true;
    }
    const auto is_same = [](const Crossing& a, const Crossing& b) {
        return a.triangle == b.triangle && a.part == b.part;
    };
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, camera.height - 1); ++row)
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, camera.width - 1);
             ++column) {
            region.crossings(line_of_sight(camera, column + 0.5, row + 0.5), there);
            if (scene.truth.triangle.at(column, row) != seen ||
                prediction.counts().at(column, row) != prediction.counts().at(x, y) ||
                !std::ranges::equal(here, there, is_same))
                return true;
        }
    return false;
}

/// Counters that the prediction at the centre does not settle are those of pixels at outlines and
/// ties, and of no others: nowhere else do techniques that are right differ from one another.
void expect_band_at_outlines(const TracedScene& scene, const Frame& frame, const Judge& judge) {
    const Prediction prediction = tests::prediction_of(scene, frame);
    int strays = 0;
    for (int y = 0; y < frame.claim.height; ++y)
        for (int x = 0; x < frame.claim.width; ++x) {
            std::optional<PixelCause> cause;
            if (judge.settles({x, y}, cause) ||
                has_outline_or_tie(scene, prediction, frame.depth_model, x, y))
                continue;
            if (strays++ == 0) ADD_FAILURE() << x << "," << y;
        }
    EXPECT_EQ(strays, 0);
}

/// Whether every caster is closed and wound outwards.
bool is_closed(const Scene& scene) {
    return std::ranges::all_of(inspect_casters(scene), [](const CasterReport& caster) {
        return caster.encloses_volume() && !caster.inverted;
    });
}

/// Whether somewhere in the picture the counter that would be right does not fit.
bool needs_more_bits(const TracedScene& scene, const Frame& frame) {
    const Prediction prediction = tests::prediction_of(scene, frame);
    return std::ranges::any_of(prediction.counts().pixels, [&](std::int64_t count) {
        return stored(count, frame.counted->counting) != static_cast<std::uint64_t>(count);
    });
}

/// It differs by edge and precision on closed casters, and on a soup by no more; by alpha where
/// some have masks, which no volume knows of. By precision only where its numbers do not suffice,
/// or for a reason.
void expect_robust(const Comparison& comparison, const TracedScene& scene, const Frame& frame,
                   std::string_view technique) {
    std::uint64_t beyond = pixels_beyond(comparison, {Cause::edge, Cause::precision});
    if (needs_more_bits(scene, frame)) beyond -= pixels_of(comparison, Cause::counter);
    const bool any_soup = technique == "zfail_per_triangle";
    if (!any_soup && !is_closed(scene.scene)) beyond -= pixels_of(comparison, Cause::open_mesh);
    if (has_masks(scene.scene)) beyond -= pixels_of(comparison, Cause::alpha);
    EXPECT_EQ(beyond, 0U);
    EXPECT_EQ(comparison.too_near, 0U);
}

/// Judged alone, a pixel is what it is in the whole picture: of every value of the cause map, some
/// of the first pixels and some of the last.
void expect_alone_as_in_the_whole(const TracedScene& scene, const Frame& frame, const Judge& judge,
                                  const Comparison& whole) {
    std::map<std::uint8_t, std::vector<std::pair<int, int>>> places;
    for (int y = 0; y < whole.cause.height; ++y)
        for (int x = 0; x < whole.cause.width; ++x) places[whole.cause.at(x, y)].emplace_back(x, y);
    for (const auto& [cause, all] : places)
        for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(1, all.size() / 2)) {
            const auto [x, y] = all[i];
            const PixelFinding alone = classify_pixel(scene.traced, frame, judge, x, y);
            EXPECT_EQ(alone.cause, cause) << x << "," << y;
            EXPECT_EQ(alone.also.bits(), whole.also.pixels.empty() ? 0U : whole.also.at(x, y));
            EXPECT_FALSE(alone.unexplained);
        }
}

TEST_P(ClassifyScene, every_technique_is_explained_and_the_robust_ones_are_right) {
    const TracedScene& scene = traced_bundled(GetParam());
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene.scene)) continue;
        SCOPED_TRACE(technique.name);
        const Frame frame = render(technique, scene.scene, scene.plan, gpu());
        const std::unique_ptr<Judge> judge = judge_of(scene.traced, frame);
        const Comparison whole = classify(scene.traced, frame, *judge);
        expect_explained(whole);
        if (frame.counted) expect_band_at_outlines(scene, frame, *judge);
        expect_alone_as_in_the_whole(scene, frame, *judge, whole);
        if (std::ranges::find(robust, technique.name) != std::end(robust))
            expect_robust(whole, scene, frame, technique.name);
    }
}

SHADOWPROOF_OVER_SCENES(ClassifyScene, bundled_names());

TEST_F(Classify, zpass_miscounts_where_the_near_plane_is_inside_a_volume_and_zfail_does_not) {
    EXPECT_GT(pixels_of(compare("near_plane", "zpass"), Cause::near_plane), 1000U);
    EXPECT_EQ(pixels_beyond(compare("near_plane", "zfail"), {Cause::edge, Cause::precision}), 0U);
}

TEST_F(Classify, zpass_miscounts_where_the_eye_is_inside_a_volume_and_zfail_does_not) {
    const Comparison zpass = compare("eye_inside", "zpass");
    EXPECT_GT(pixels_of(zpass, Cause::eye_inside), 1000U);
    EXPECT_EQ(pixels_of(zpass, Cause::near_plane), 0U);
    EXPECT_EQ(pixels_beyond(compare("eye_inside", "zfail"), {Cause::edge, Cause::precision}), 0U);
}

TEST_F(Classify, zfail_miscounts_where_the_far_plane_cuts_a_volume_and_zpass_does_not) {
    EXPECT_GT(pixels_of(compare("far_plane", "zfail"), Cause::far_plane), 1000U);
    EXPECT_EQ(pixels_beyond(compare("far_plane", "zpass"), {Cause::edge, Cause::precision}), 0U);
}

TEST_F(Classify, every_pixel_counted_by_cause_is_marked_in_the_cause_map) {
    const Comparison comparison = compare("near_plane", "zpass");
    std::array<std::uint64_t, all_causes.size()> marked{};
    for (const std::uint8_t cause : comparison.cause.pixels)
        if (cause != no_difference) ++marked[cause];
    EXPECT_EQ(marked, comparison.causes);
    EXPECT_EQ(std::accumulate(marked.begin(), marked.end(), std::uint64_t{0}),
              comparison.differing);
    ASSERT_TRUE(comparison.first);
    EXPECT_EQ(comparison.cause.at(comparison.first->x, comparison.first->y),
              static_cast<std::uint8_t>(comparison.first->cause));
}

TEST(Wrongness, is_the_share_of_the_light_by_which_a_partly_lit_pixel_is_off_and_else_1) {
    Image<Visibility> truth(1, 1);
    Frame frame;
    frame.claim = Image<Visibility>(1, 1);
    frame.share = Image<double>(1, 1, 11.0 / 16);
    const auto off = [&](Visibility right, Visibility claim) {
        truth.pixels[0] = right;
        frame.claim.pixels[0] = claim;
        return wrongness(truth, frame, 0);
    };
    EXPECT_EQ(off(Visibility::lit, Visibility::partly_lit), 5.0 / 16);
    EXPECT_EQ(off(Visibility::shadowed, Visibility::partly_lit), 11.0 / 16);
    EXPECT_EQ(off(Visibility::background, Visibility::partly_lit), 1);
    // The share of a pixel that is not partly lit is not read.
    EXPECT_EQ(off(Visibility::shadowed, Visibility::lit), 1);
    EXPECT_EQ(off(Visibility::lit, Visibility::shadowed), 1);
}

/// A block of wrong counters in a corner of the picture: those are unexplained, and no other pixel
/// is given up for them.
TEST_F(Classify, a_block_of_wrong_counters_leaves_all_other_pixels_explained) {
    const TracedScene& scene = traced_bundled("ordinary");
    Gpu gpu(GlPlatform::osmesa);
    const Frame right = render(*find_technique("zfail_reversed"), scene.scene, scene.plan, gpu);
    const Comparison explained = compared(scene, right);
    ASSERT_EQ(explained.evidence.unexplained, 0U);
    ASSERT_GT(explained.evidence.in_band, 20U);
    Frame wrong = right;
    std::uint64_t changed = 0;
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x, ++changed) wrong.counted->counter.at(x, y) += 7;
    const Comparison found = compared(scene, wrong);
    EXPECT_EQ(found.evidence.unexplained, changed);
    EXPECT_EQ(found.evidence.in_band, explained.evidence.in_band);
}

/// Nearly all of the picture: it is given up soon, and nothing of that is called explained.
TEST_F(Classify, a_picture_of_wrong_counters_is_unexplained_nearly_everywhere) {
    const TracedScene& scene = traced_bundled("ordinary");
    Gpu gpu(GlPlatform::osmesa);
    Frame wrong = render(*find_technique("zfail_reversed"), scene.scene, scene.plan, gpu);
    for (std::uint32_t& counter : wrong.counted->counter.pixels) counter += 7;
    const Comparison found = compared(scene, wrong);
    EXPECT_EQ(found.evidence.equal + found.evidence.in_band, 0U);
    EXPECT_EQ(found.evidence.unexplained, wrong.claim.pixels.size());
}

/// Each fault on a scene that shows it (the headers of the faults say which).
struct Injection {
    std::string fault;
    std::string scene;
    std::string twin; ///< the technique that has the fault's recipe without it
};

class ClassifyFault : public Classify, public testing::WithParamInterface<Injection> {};

TEST_P(ClassifyFault, is_caught_and_its_right_twin_is_not) {
    const Technique* faulty = nullptr;
    for (const Technique& technique : tests::faulty_techniques())
        if (technique.name == GetParam().fault) faulty = &technique;
    ASSERT_NE(faulty, nullptr);
    const Scene& scene = traced_bundled(GetParam().scene).scene;
    const Verdict verdict = judge(scene, faulty->fails_at, {}, compare(GetParam().scene, *faulty));
    EXPECT_TRUE(verdict == Verdict::defect || verdict == Verdict::unexplained) << name_of(verdict);
    const Technique& right = *find_technique(GetParam().twin);
    const Verdict unharmed =
        judge(scene, right.fails_at, right.by_nature, compare(GetParam().scene, right));
    EXPECT_TRUE(unharmed == Verdict::agrees || unharmed == Verdict::fails_as_predicted)
        << name_of(unharmed);
}

INSTANTIATE_TEST_SUITE_P(
    Injected, ClassifyFault,
    testing::Values(Injection{"without_dark_cap", "far_plane", "zfail_reversed"},
                    Injection{"with_swapped_steps", "ordinary", "zfail_clamp"},
                    Injection{"without_one_side", "ordinary", "zfail_clamp"},
                    Injection{"with_wrong_near_plane", "near_plane", "zpass"},
                    Injection{"with_wrong_near_plane", "eye_inside", "zpass"},
                    Injection{"with_mirrored_light", "ordinary", "zfail_reversed"},
                    Injection{"with_all_caps_hidden", "inverted", "zpass"}),
    [](const testing::TestParamInfo<Injection>& injection) {
        return injection.param.fault + "_on_" + injection.param.scene;
    });

} // namespace
} // namespace shadowproof
