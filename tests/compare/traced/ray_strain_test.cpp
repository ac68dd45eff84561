// How near traced techniques are to failing, worked out without looking at what they traced: as
// many pixels are wrong as are expected, and none where floats suffice.
#include "scenes/stress/parameter.h"
#include "tests/compare/traced_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace shadowproof {
namespace {

Scene small(const std::string& name) {
    return tests::square_scene(name, 160);
}

/// A technique's picture of a scene, and its judge.
struct Rays {
    tests::TracedScene traced;
    Frame frame;

    Rays(Gpu& gpu, Scene scene, const char* technique, const RaySettings& settings = {})
        : traced(std::move(scene)) {
        traced.plan.asked.rays = settings;
        frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
    }

    /// Pixels.
    double expected() const {
        return judge_of(traced.traced, frame)->strain().value() * std::numbers::ln2;
    }
    double wrong() const {
        double count = 0;
        for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
            count += frame.claim.pixels[i] != traced.truth.visibility.pixels[i] ? 1 : 0;
        return count;
    }
};

void expect_within_a_factor_of_four(const Rays& rays, const std::string& where) {
    EXPECT_GT(rays.wrong(), 20) << where;
    EXPECT_LT(rays.expected(), 4 * rays.wrong()) << where;
    EXPECT_GT(rays.expected(), rays.wrong() / 4) << where;
}

/// Without a distance that is kept, every other ray may start below its surface.
TEST(RayStrain, tells_how_many_rays_meet_the_surface_that_they_start_on) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"ordinary", "nested", "far_plane"})
        for (const double distance : {0.0, 1e-7})
            for (const char* technique : {"traced_epsilon", "traced_offset"})
                expect_within_a_factor_of_four(
                    Rays(gpu, small(name), technique, {.epsilon = distance, .offset = distance}),
                    std::string(name) + ", " + technique);
}

/// Roundings grow with coordinates: a ray then starts below the next triangle as well, or beyond
/// the border of a shadow.
TEST(RayStrain, tells_how_many_are_wrong_far_from_the_origin) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"ordinary", "eye_inside"})
        for (const double distance : {1e4, 1e5})
            expect_within_a_factor_of_four(
                Rays(gpu, stressed(small(name), {"origin_distance", distance}), "traced_skip"),
                std::string(name) + ", " + std::to_string(distance));
    expect_within_a_factor_of_four(
        Rays(gpu, stressed(small("ordinary"), {"origin_distance", 1e3}), "traced_epsilon"),
        "traced_epsilon");
}

/// Where rays are right everywhere on a scene as it is, they are expected to be; borders through
/// pixels' centres and lights on edges are no reason for doubt.
TEST(RayStrain, is_next_to_none_where_floats_suffice) {
    Gpu gpu(GlPlatform::osmesa);
    int right = 0;
    for (const BundledScene& entry : bundled_scenes()) {
        const std::string name(entry.name);
        for (const char* technique : {"traced_epsilon", "traced_offset", "traced_skip"}) {
            const Rays rays(gpu, small(name), technique);
            if (rays.wrong() > 0) continue;
            ++right;
            EXPECT_LT(rays.expected(), std::numbers::ln2) << name << ", " << technique;
        }
    }
    EXPECT_GT(right, 20);
}

/// An epsilon that is longer than the way to what stands before the light passes over that, in
/// exact numbers, too; a ray that skips nothing but its own triangle does not.
TEST(RayStrain, is_infinite_where_exact_rays_are_wrong) {
    Gpu gpu(GlPlatform::osmesa);
    const RaySettings long_ones{.epsilon = 1.0, .offset = 1.0};
    EXPECT_TRUE(std::isinf(Rays(gpu, small("ordinary"), "traced_epsilon", long_ones).expected()));
    EXPECT_TRUE(std::isinf(Rays(gpu, small("ordinary"), "traced_offset", long_ones).expected()));
    EXPECT_TRUE(std::isfinite(Rays(gpu, small("ordinary"), "traced_skip").expected()));
}

TEST(RayStrain, is_the_same_whatever_was_traced) {
    Gpu gpu(GlPlatform::osmesa);
    Rays rays(gpu, stressed(small("ordinary"), {"origin_distance", 1e3}), "traced_epsilon");
    const double as_traced = rays.expected();
    EXPECT_GT(as_traced, 0);
    std::ranges::fill(rays.frame.claim.pixels, Visibility::lit);
    std::ranges::fill(rays.frame.rays->pixels.pixels, TracedPixel{});
    EXPECT_EQ(rays.expected(), as_traced);
}

} // namespace
} // namespace shadowproof
