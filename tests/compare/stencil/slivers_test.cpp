// Slivers that snapping flips: what their light caps do to a counter is explained, and no
// more.
#include "scenes/load/catalog.h"
#include "scenes/stress/parameter.h"
#include "tests/compare/traced_scene.h"

#include <gtest/gtest.h>

namespace shadowproof::tests {
namespace {

Scene with_slivers(const char* name, double aspect) {
    SceneRequest request;
    request.width = request.height = 64;
    return stressed(load_scene(name, request), {"sliver_aspect", aspect});
}

TEST(Slivers, a_cap_that_is_turned_over_takes_one_from_the_counter) {
    const TracedScene traced(with_slivers("eye_inside", 1e4));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    // Of the sliver at the pixel, the neighbours' caps reach over it, and its own comes out in
    // front.
    ASSERT_EQ(frame.counted->counter.at(46, 21), 255U);
    ASSERT_EQ(predicted_counter(traced, frame, 46, 21), 0U);
    const Comparison comparison = compared(traced, frame);
    EXPECT_EQ(comparison.evidence.unexplained, 0U);
    EXPECT_EQ(static_cast<Cause>(comparison.cause.at(46, 21)), Cause::precision);
    // 1 would be right if the flipped cap came out behind the surface.
    for (const std::uint32_t counter : {254U, 2U}) {
        Frame faulty = frame;
        faulty.counted->counter.at(46, 21) = counter;
        EXPECT_EQ(compared(traced, faulty).evidence.unexplained, 1U) << counter;
    }
}

TEST(Slivers, a_counter_that_is_one_short_where_no_cap_turns_is_unexplained) {
    const TracedScene traced(with_slivers("eye_inside", 100));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    ASSERT_EQ(compared(traced, frame).evidence.unexplained, 0U);
    int tried = 0;
    int excused = 0;
    for (int y = 3; y < 64; y += 4)
        for (int x = 3; x < 64; x += 4) {
            if (frame.claim.at(x, y) != Visibility::lit) continue;
            Frame faulty = frame;
            faulty.counted->counter.at(x, y) = 255;
            faulty.claim.at(x, y) = Visibility::shadowed;
            ++tried;
            excused += compared(traced, faulty).evidence.unexplained == 1 ? 0 : 1;
        }
    EXPECT_GT(tried, 60);
    EXPECT_EQ(excused, 0);
}

TEST(Slivers, of_any_aspect_are_explained) {
    Gpu gpu(GlPlatform::osmesa);
    for (const double aspect : {1e3, 1e5, 1e7, 1e9}) {
        const TracedScene traced(with_slivers("ordinary", aspect));
        for (const char* name : {"zfail_reversed", "zfail", "zpass", "auto"}) {
            const Comparison comparison = compared(traced, name, gpu);
            EXPECT_EQ(comparison.evidence.unexplained, 0U) << name << ", " << aspect;
            EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U) << name << ", " << aspect;
        }
    }
}

} // namespace
} // namespace shadowproof::tests
