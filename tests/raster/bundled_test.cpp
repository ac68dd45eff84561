// The techniques against each other on the scenes that come with the program.
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "tests/raster/faulty_techniques.h"

#include <gtest/gtest.h>

#include <cstddef>

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
    // The plan does not ask which way a triangle faces: of a caster around the light that shows its
    // outside, as glass does, no triangle has a volume, yet all of them are seen to infinity.
    EXPECT_TRUE(shows || !plan.dark_cap || !plan.around_light.empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bundled, testing::ValuesIn(bundled_scenes()),
                         [](const auto& scene) { return std::string(scene.param.name); });

} // namespace
} // namespace shadowproof::tests
