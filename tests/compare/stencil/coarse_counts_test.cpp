// What a counter may hold by the errors of all that is drawn: every counter is among it, and nearly
// everywhere nothing else is.
#include "compare/stencil/coarse_counts.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace shadowproof::tests {
namespace {

constexpr double any_reach = std::numeric_limits<double>::infinity();

struct Counts {
    std::vector<PixelPlace> places;
    std::vector<CoarseCount> counts;
};

Counts counts_of(const TracedScene& traced, const Frame& frame, double reach = any_reach) {
    const Prediction prediction = prediction_of(traced, frame);
    const CountedClaim claim{{traced.traced, frame}, prediction, {}, {}};
    Counts all;
    for (int y = 0; y < frame.claim.height; ++y)
        for (int x = 0; x < frame.claim.width; ++x) all.places.push_back({x, y});
    all.counts = coarse_counts(claim, all.places, std::vector<double>(all.places.size(), reach));
    return all;
}

class CoarseCountsOfScene : public testing::TestWithParam<std::string> {};

TEST_P(CoarseCountsOfScene, hold_every_counter_and_little_else) {
    Scene scene = load_named(GetParam());
    scene.camera.width = scene.camera.height = 24;
    const TracedScene traced(std::move(scene));
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, traced.scene)) continue;
        SCOPED_TRACE(technique.name);
        const Frame frame = render(technique, traced.scene, traced.plan, gpu);
        if (!frame.counted) continue;
        const auto [places, counts] = counts_of(traced, frame);
        std::size_t single = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto [x, y] = places[i];
            const std::uint32_t read = frame.counted->counter.at(x, y);
            EXPECT_TRUE(counts[i].may_hold(read, frame.counted->counting))
                << x << ", " << y << ": " << read << " in " << counts[i].counter.low << " to "
                << counts[i].counter.high;
            EXPECT_TRUE(counts[i].may_be_seen) << x << ", " << y;
            if (counts[i].counter.low == counts[i].counter.high) ++single;
        }
        // All but pixels at the outlines of faces. What is drawn in the near plane is not known
        // where a caster touches the light.
        const bool is_known = frame.counted->volume_faces.near_plane == NearPlane::lost;
        EXPECT_TRUE(!is_known || 2 * single > places.size()) << single;
    }
}

SHADOWPROOF_OVER_SCENES(CoarseCountsOfScene, bundled_names());

} // namespace
} // namespace shadowproof::tests
