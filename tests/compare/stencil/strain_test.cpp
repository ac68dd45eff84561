// How near techniques are to failing, worked out without looking at what they drew.
#include "scenes/stress/parameter.h"
#include "tests/compare/traced_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace shadowproof {
namespace {

using tests::TracedScene;

Scene small(const char* name) {
    return tests::square_scene(name, 160);
}

double strain_of(Gpu& gpu, const Scene& scene, const char* technique) {
    const TracedScene traced(scene);
    const Frame frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
    return judge_of(traced.traced, frame)->strain().value();
}

TEST(Strain, of_fixed_point_depths_grows_as_the_near_plane_comes_nearer_and_of_reversed_not) {
    Gpu gpu(GlPlatform::osmesa);
    const auto at = [&](const char* technique, double near) {
        return strain_of(gpu, stressed(small("ordinary"), {"near_plane", near}), technique);
    };
    const double before = at("zfail_infinite", 1e-4);
    const double after = at("zfail_infinite", 1e-5);
    EXPECT_GT(before, 1);
    EXPECT_GT(after, 5 * before);
    EXPECT_LT(after, 15 * before);
    EXPECT_LT(at("zfail_reversed", 1e-5), 0.5);
}

TEST(Strain, is_infinite_only_where_the_algorithm_shows_something_else_than_the_truth) {
    Gpu gpu(GlPlatform::osmesa);
    EXPECT_TRUE(std::isinf(strain_of(gpu, small("near_plane"), "zpass")));
    EXPECT_TRUE(std::isfinite(strain_of(gpu, small("near_plane"), "zfail")));
    EXPECT_TRUE(std::isinf(strain_of(gpu, small("far_plane"), "zfail")));
    EXPECT_TRUE(std::isfinite(strain_of(gpu, small("far_plane"), "zpass")));
}

TEST(Strain, comes_from_no_face_that_is_drawn_with_the_same_depths) {
    Gpu gpu(GlPlatform::osmesa);
    const Scene scene = small("ordinary");
    const double once = strain_of(gpu, scene, "zfail_reversed");
    const double often = strain_of(gpu, stressed(scene, {"coincident_faces", 5}), "zfail_reversed");
    EXPECT_LT(often, 2 * once + 0.1);
}

TEST(Strain, is_the_same_whatever_was_drawn) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(stressed(small("ordinary"), {"near_plane", 1e-3}));
    Frame frame = render(*find_technique("zfail"), traced.scene, traced.plan, gpu);
    const double drawn = judge_of(traced.traced, frame)->strain().value();
    EXPECT_GT(drawn, 0);
    std::ranges::fill(frame.counted->counter.pixels, 7U);
    std::ranges::fill(frame.claim.pixels, Visibility::lit);
    std::ranges::fill(frame.depth.pixels, 0.5F);
    std::ranges::fill(frame.triangle.pixels, 0U);
    EXPECT_EQ(judge_of(traced.traced, frame)->strain().value(), drawn);
}

TEST(Strain, of_maps_nothing_is_derived) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(small("ordinary"));
    const Frame frame =
        render(*find_technique("cube_map_six_pass"), traced.scene, traced.plan, gpu);
    EXPECT_FALSE(judge_of(traced.traced, frame)->strain());
}

} // namespace
} // namespace shadowproof
