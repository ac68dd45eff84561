// Techniques that find shadows in one way and light bumps in another: the halves meet.
#include "compare/color/color_check.h"
#include "compare/evidence.h"
#include "raster/technique.h"
#include "reference/shade/shading.h"
#include "tests/compare/traced_scene.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace shadowproof {
namespace {

using tests::compared;
using tests::load_named;
using tests::TracedScene;

Scene small(const std::string& name) {
    Scene scene = load_named(name);
    scene.camera.width = scene.camera.height = 64;
    return scene;
}

class Joined : public testing::TestWithParam<std::string> {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene traced{small(GetParam())};

    Frame drawn(const std::string& name) {
        return render(*find_technique(name), traced.scene, traced.plan, gpu);
    }
};

/// Each claims what the one that finds shadows claims, and where that is right it shows the colours
/// of the technique that it lights as.
TEST_P(Joined, find_shadows_as_the_one_and_light_as_the_other) {
    for (const std::string_view shadowing : shadowing_techniques()) {
        if (!suits(*find_technique(shadowing), traced.scene)) continue; // another kind of light
        const Frame shadowed = drawn(std::string(shadowing));
        for (const std::string_view lighting : lighting_techniques()) {
            const std::string name = std::string(lighting) + "+" + std::string(shadowing);
            SCOPED_TRACE(name);
            const Technique* technique = find_technique(name);
            ASSERT_NE(technique, nullptr);
            if (!suits(*technique, traced.scene)) continue;
            const Frame frame = drawn(name);
            EXPECT_EQ(frame.claim.pixels, shadowed.claim.pixels);
            if (frame.counted) {
                EXPECT_EQ(frame.counted->counter.pixels, shadowed.counted->counter.pixels);
            }
            const Comparison comparison = compared(traced, frame);
            EXPECT_TRUE(is_explained(comparison));
            ASSERT_TRUE(comparison.colors);
            EXPECT_EQ(comparison.colors->unpredicted, 0U);
        }
    }
}

/// Where the driver rounds what comes from a geometry shader as it does nothing else: half of the
/// picture's width is no power of two.
TEST(JoinedTechniques, light_what_a_geometry_shader_drew) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"bumpy_torus", "height_field", "skewed_relief"}) {
        SCOPED_TRACE(name);
        Scene scene = load_named(name);
        scene.camera.width = scene.camera.height = 96;
        const TracedScene traced(std::move(scene));
        const Comparison comparison = compared(traced, "bump_eye_space+zfail_geometry_shader", gpu);
        EXPECT_TRUE(is_explained(comparison));
        EXPECT_EQ(comparison.colors->unpredicted, 0U);
    }
}

INSTANTIATE_TEST_SUITE_P(Bumps, Joined,
                         testing::Values("bumpy_near_plane", "bumpy_far_plane", "bumpy_eye_inside",
                                         "coarse_curve", "grazing_light", "hammered_silver",
                                         "bumpy_lights-spot"));

/// What stands behind the + decides whether the plane or the eye spoils the light.
TEST(JoinedTechniques, spoil_colours_where_what_they_count_by_fails) {
    Gpu gpu(GlPlatform::osmesa);
    struct Case {
        const char* scene;
        const char* spoilt;
        const char* whole;
        Cause cause;
    };
    for (const Case& tried : {Case{"bumpy_near_plane", "bump_tangent_space+zpass",
                                   "bump_tangent_space+zpass_capped", Cause::near_plane},
                              Case{"bumpy_far_plane", "bump_tangent_space+zfail",
                                   "bump_tangent_space+zfail_infinite", Cause::far_plane},
                              Case{"bumpy_eye_inside", "bump_tangent_space+zpass",
                                   "bump_tangent_space+zpass_eye_count", Cause::eye_inside}}) {
        SCOPED_TRACE(tried.scene);
        Scene scene = load_named(tried.scene);
        scene.camera.width = scene.camera.height = 128;
        const TracedScene traced(std::move(scene));
        const Comparison spoilt = compared(traced, tried.spoilt, gpu);
        const Comparison whole = compared(traced, tried.whole, gpu);
        EXPECT_GT(tests::pixels_of(spoilt, tried.cause), 1000U);
        EXPECT_EQ(tests::pixels_of(whole, tried.cause), 0U);
        // Where shadows are right, so are the colours; the whole picture tells of the others.
        EXPECT_LT(spoilt.colors->largest, 1);
        EXPECT_GT(spoilt.colors->picture_rmse, 10);
        EXPECT_LT(whole.colors->picture_rmse, 3);
    }
}

/// Colours that follow other shadows than the technique claims.
TEST(JoinedTechniques, with_the_colours_of_other_shadows_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(small("bumpy_near_plane"));
    const auto drawn = [&](const char* name) {
        return render(*find_technique(name), traced.scene, traced.plan, gpu);
    };
    Frame frame = drawn("bump_tangent_space+zpass");
    EXPECT_EQ(check_colors(traced.tracer, traced.truth, frame).unpredicted, 0U);
    frame.color = drawn("bump_tangent_space").color;
    EXPECT_GT(check_colors(traced.tracer, traced.truth, frame).unpredicted, 300U);
}

TEST(JoinedTechniques, tell_the_error_of_the_whole_picture) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(small("bumpy_eye_inside"));
    Frame frame =
        render(*find_technique("bump_tangent_space+zpass"), traced.scene, traced.plan, gpu);
    double squares = 0;
    const Image<glm::dvec3> right = shade(traced.tracer, traced.truth);
    for (std::size_t i = 0; i < right.pixels.size(); ++i) {
        const glm::dvec3 off = 255.0 * (glm::dvec3(frame.color.pixels[i]) - right.pixels[i]);
        squares += glm::dot(off, off);
    }
    const double rmse = std::sqrt(squares / (3.0 * static_cast<double>(right.pixels.size())));
    EXPECT_NEAR(check_colors(traced.tracer, traced.truth, frame).picture_rmse, rmse, 1e-6 * rmse);
}

} // namespace
} // namespace shadowproof
