// The band counts faces ray by ray in doubles, the prediction from exact shadow depths. On a
// pixel's own ray, with nothing moved, both must say the same: what the band says of moved faces
// then stands on firm ground, and nothing that a technique left out wrongly is excused by it.
#include "compare/stencil/band.h"
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace shadowproof {
namespace {

class BandOfScene : public testing::TestWithParam<std::string> {};

/// Whether a face lies in the very surface that is seen, as what fills a T-junction does: doubles
/// do not tell which comes first.
bool lies_in_surface(const std::vector<Crossing>& crossings, double surface) {
    return std::ranges::any_of(crossings, [&](const Crossing& crossing) {
        return std::abs(crossing.depth - surface) <= 0x1p-40 * crossing.depth;
    });
}

/// What the band says of the pixel's centre, unmoved, if its surface is seen there.
std::optional<std::int64_t> unmoved_count(const Tracer& tracer, const Prediction& prediction,
                                          const ShadowDepths& depths, const Frame& frame,
                                          std::uint32_t seen, int x, int y) {
    const Camera& camera = tracer.scene().camera;
    const Neighbourhood around = neighbourhood(camera, {x + 0.5, y + 0.5}, {});
    const Volumes& volumes = prediction.volumes();
    RegionLedger counted = volumes.ledger(corner_lines(camera, x, y, x + 1, y + 1));
    const PixelVolumes here{.counted = counted,
                            .casters = volumes.casters(),
                            .far_ends = volumes.far_ends(),
                            .ideal = nullptr,
                            .flat = volumes.flat(),
                            .counted_at_eye = prediction.depths().at_eye,
                            .ideal_at_eye = prediction.depths().at_eye,
                            .masked = has_masks(tracer.scene()) ? &volumes : nullptr};
    const std::vector<RayTruth> truth = trace_rays(tracer, around.rays);
    const PixelBand band = find_band(tracer, here, frame, depths.far, seen, around, truth,
                                     [](const Reading&) { return false; });
    std::optional<std::int64_t> count;
    for (const Reading& reading : band.readings)
        if (!reading.by_rounding) count = reading.count;
    return count;
}

TEST_P(BandOfScene, reads_what_is_predicted_where_nothing_is_moved) {
    const Scene scene =
        load_scene(GetParam(), {.camera = {}, .light = {}, .time = 0, .width = 67, .height = 67});
    const Plan plan = make_plan(scene);
    const Tracer tracer(scene);
    const Silhouette silhouette(tracer);
    const GroundTruth truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, truth, finite_far(scene));
    const VolumeStore volumes(tracer, silhouette, truth, depths);
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        SCOPED_TRACE(technique.name);
        const Frame frame = render(technique, scene, plan, gpu);
        if (!frame.counted) continue;
        const Prediction prediction(volumes, frame.counted->counting, frame.depth_model);
        std::vector<Crossing> crossings;
        int asked = 0;
        for (int y = 0; y < 67; y += 3)
            for (int x = 0; x < 67; x += 3) {
                if (truth.exactness.at(x, y) == Exactness::degenerate) continue;
                RegionLedger ledger =
                    prediction.volumes().ledger(corner_lines(scene.camera, x, y, x + 1, y + 1));
                ledger.crossings(line_of_sight(scene.camera, x + 0.5, y + 0.5), crossings);
                std::erase_if(crossings, [&](const Crossing& crossing) {
                    return crossing.triangle == truth.triangle.at(x, y); // its own cap
                });
                if (lies_in_surface(crossings, truth.depth.at(x, y))) continue;
                const std::optional<std::int64_t> count =
                    unmoved_count(tracer, prediction, depths, frame, truth.triangle.at(x, y), x, y);
                ASSERT_TRUE(count.has_value()) << x << "," << y;
                ++asked;
                EXPECT_EQ(*count, prediction.counts().at(x, y)) << x << "," << y;
            }
        EXPECT_GT(asked, 100);
    }
}

SHADOWPROOF_OVER_SCENES(BandOfScene, tests::bundled_scene_names());

} // namespace
} // namespace shadowproof
