// The techniques against each other on the scenes that come with the program.
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "tests/raster/faulty_techniques.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof::tests {
namespace {

constexpr const char* robust[]{"zfail_clamp", "zfail_infinite", "zfail_reversed"};

class Bundled : public testing::TestWithParam<BundledScene> {
protected:
    Gpu gpu{GlPlatform::osmesa};
    Scene scene = load_scene(std::string(GetParam().name), {});
    Plan plan = make_plan(scene);
};

template <class T>
std::size_t differing(const Image<T>& a, const Image<T>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (a.pixels[i] != b.pixels[i]) ++count;
    return count;
}

/// Whether one of the eight pixels around has another claim.
bool at_silhouette(const Image<Visibility>& claim, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, claim.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, claim.width - 1); ++u)
            if (claim.at(u, v) != claim.at(x, y)) return true;
    return false;
}

TEST_P(Bundled, the_robust_techniques_differ_in_silhouette_pixels_alone_and_few) {
    const Frame reversed = render(*find_technique("zfail_reversed"), scene, plan, gpu);
    for (const char* technique : robust) {
        const Frame frame = render(*find_technique(technique), scene, plan, gpu);
        // Measured: at most 1 on each scene; the ledger's band of D24 is 0 to 0.3 % of the pixels.
        EXPECT_LE(differing(frame.claim, reversed.claim), 10U) << technique;
        for (int y = 0; y < frame.claim.height; ++y) {
            for (int x = 0; x < frame.claim.width; ++x) {
                const bool same = frame.claim.at(x, y) == reversed.claim.at(x, y);
                EXPECT_TRUE(same || at_silhouette(frame.claim, x, y) ||
                            at_silhouette(reversed.claim, x, y))
                    << technique << " " << x << "," << y;
            }
        }
    }
}

TEST_P(Bundled, what_the_plan_leaves_out_changes_no_pixel) {
    Plan everything = plan;
    everything.dark_cap = true;
    everything.volume_meets_far = true;
    for (const char* technique : robust) {
        const Frame with = render(*find_technique(technique), scene, everything, gpu);
        const Frame without = render(*find_technique(technique), scene, plan, gpu);
        EXPECT_EQ(with.counted->counter.pixels, without.counted->counter.pixels) << technique;
        EXPECT_EQ(with.claim.pixels, without.claim.pixels) << technique;
    }
}

TEST_P(Bundled, a_missing_dark_cap_shows_where_the_plan_keeps_it_and_only_there) {
    const Frame right = render(*find_technique("zfail_reversed"), scene, plan, gpu);
    const Frame wrong = without_dark_cap(gpu, scene, plan);
    const bool shows = differing(wrong.counted->counter, right.counted->counter) > 0;
    EXPECT_TRUE(plan.dark_cap || !shows);
    // The plan does not ask which way a triangle faces: no triangle of the glass around the light
    // has a volume, yet all of them are seen to infinity.
    EXPECT_TRUE(shows || !plan.dark_cap || GetParam().name == "light_inside");
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bundled, testing::ValuesIn(bundled_scenes()),
                         [](const auto& scene) { return std::string(scene.param.name); });

} // namespace
} // namespace shadowproof::tests
