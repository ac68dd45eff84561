#include "raster/passes/passes.h"
#include "raster/render.h"
#include "raster/volumes/near_cap.h"
#include "scenes/error.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <thread>

namespace shadowproof::tests {
namespace {

void expect_same(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.claim.pixels, b.claim.pixels);
    ASSERT_EQ(a.counted.has_value(), b.counted.has_value());
    if (a.counted) {
        EXPECT_EQ(a.counted->counter.pixels, b.counted->counter.pixels);
    }
    ASSERT_EQ(a.mapped.has_value(), b.mapped.has_value());
    for (std::size_t face = 0; a.mapped && face < a.mapped->faces.size(); ++face)
        EXPECT_EQ(a.mapped->faces[face].pixels, b.mapped->faces[face].pixels) << face;
    EXPECT_EQ(a.depth.pixels, b.depth.pixels);
    EXPECT_EQ(a.triangle.pixels, b.triangle.pixels);
    EXPECT_EQ(a.color.pixels, b.color.pixels);
}

TEST(Render, is_bit_identical_over_runs_techniques_between_and_a_fresh_context) {
    const Scene scene = box_over_floor();
    Gpu gpu(GlPlatform::osmesa);
    std::map<std::string_view, Frame> frames;
    for (const Technique& technique : all_techniques())
        if (suits(technique, scene))
            frames.emplace(technique.name, render(technique, scene, Plan{}, gpu));
    Gpu fresh(GlPlatform::osmesa);
    for (const auto& [name, frame] : frames) {
        SCOPED_TRACE(name);
        expect_same(frame, render(*find_technique(name), scene, Plan{}, gpu));
        expect_same(frame, render(*find_technique(name), scene, Plan{}, fresh));
    }
}

TEST(Render, gives_the_same_pixels_through_egl) {
    const Scene scene = box_over_floor();
    Gpu osmesa(GlPlatform::osmesa);
    Gpu egl(GlPlatform::egl);
    if (egl.driver().renderer.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "EGL draws with " << egl.driver().renderer;
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        SCOPED_TRACE(technique.name);
        expect_same(render(technique, scene, Plan{}, osmesa),
                    render(technique, scene, Plan{}, egl));
    }
}

TEST(Render, works_on_another_thread_than_the_contexts_own) {
    const Scene scene = box_over_floor();
    const Technique& technique = *find_technique("zfail_reversed");
    Frame here;
    Frame there;
    {
        Gpu gpu(GlPlatform::osmesa);
        here = render(technique, scene, Plan{}, gpu);
    }
    std::thread([&] {
        Gpu gpu(GlPlatform::osmesa);
        there = render(technique, scene, Plan{}, gpu);
    }).join();
    expect_same(here, there);
}

TEST(Render, has_its_first_row_at_the_top_and_its_first_column_on_the_left) {
    Scene scene = empty_scene();
    add_rectangle(scene, {-4, 1, 0}, {-1, 1, 0}, {-1, 4, 0}, {-4, 4, 0});
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_reversed"), scene, Plan{}, gpu);
    EXPECT_EQ(frame.claim.at(16, 16), Visibility::lit);
    EXPECT_LT(frame.triangle.at(16, 16), 2U);
    EXPECT_GT(frame.depth.at(16, 16), 0);
    for (const Pixel pixel : {Pixel{48, 16}, Pixel{16, 48}, Pixel{48, 48}}) {
        EXPECT_EQ(frame.claim.at(pixel.x, pixel.y), Visibility::background);
        EXPECT_EQ(frame.triangle.at(pixel.x, pixel.y), no_triangle);
        EXPECT_EQ(frame.depth.at(pixel.x, pixel.y), 0);
    }
}

TEST(Render, says_how_it_counted_and_how_it_made_depth) {
    Scene scene = box_over_floor();
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        const Frame frame = render(technique, scene, Plan{}, gpu);
        const bool reversed = frame.depth_model.reversed();
        const bool fail = technique.name.starts_with("zfail");
        if (frame.counted && technique.name != "auto") {
            EXPECT_EQ(frame.counted->counting.test,
                      fail ? Counting::Test::depth_fail : Counting::Test::depth_pass);
        }
        if (frame.counted) {
            EXPECT_EQ(frame.counted->counting.bits, technique.name == "zfail_float" ? 24 : 8);
            EXPECT_EQ(frame.counted->counting.casters.empty(), technique.name != "auto");
        }
        EXPECT_GT(frame.milliseconds, 0);
        if (frame.rays) continue; // no depth buffer
        EXPECT_EQ(frame.depth_model.clamp, technique.name == "zfail_clamp");
        EXPECT_EQ(frame.depth_model.floating, reversed);
        EXPECT_EQ(frame.depth_model.eye_relative, reversed);
        EXPECT_EQ(frame.depth_model.near, scene.camera.near);
        EXPECT_EQ(frame.depth_model.subpixel_bits, 8);
        EXPECT_EQ(std::isfinite(frame.depth_model.far), frame.depth_model.finite());
    }
}

TEST(Render, keeps_eye_and_light_to_48_bits_in_two_floats_a_coordinate) {
    Scene scene = empty_scene();
    scene.camera.eye = {4097.337, -8186.727, 16396.617};
    scene.lights[0].position = {-4100.1, 8190.3, 0.1};
    const ClipTransform transform = clip_transform(scene, {.eye_relative = true});
    const auto expect_kept = [](const glm::dvec3& point, const TwoFloats& sum) {
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(double{sum.high[k]} + double{sum.low[k]}, point[k],
                        std::ldexp(std::abs(point[k]), -48));
    };
    expect_kept(scene.camera.eye, transform.origin);
    expect_kept(scene.lights[0].position, transform.light);
}

TEST(Render, stores_the_window_depth_that_the_depth_model_says) {
    Scene scene = empty_scene();
    add_rectangle(scene, {-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2}); // depth 3
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        const Frame frame = render(technique, scene, Plan{}, gpu);
        if (!frame.shows_surface()) continue; // rays have no depth buffer
        const double n = frame.depth_model.near;
        const double f = frame.depth_model.far;
        using Projection = DepthModel::Projection;
        const double expected = frame.depth_model.projection == Projection::finite
                                    ? f * (3 - n) / (3 * (f - n))
                                : frame.depth_model.projection == Projection::finite_reversed
                                    ? n * (f - 3) / (3 * (f - n))
                                : frame.depth_model.projection == Projection::infinite ? 1 - n / 3
                                                                                       : n / 3;
        // The caps on the near plane take a ledge of the depths.
        const double least = technique.name == "zpass_capped" ? ledge : 0;
        // 16 steps of 24 bits: what the ledger grants D24 for its rounding and that of the matrix.
        EXPECT_NEAR(frame.depth.at(20, 40), least + (1 - least) * expected, std::ldexp(16, -24))
            << technique.name;
    }
}

TEST(Render, under_a_light_that_is_a_direction_a_box_shadows_what_lies_straight_below) {
    Scene scene = box_over_floor();
    scene.lights[0].kind = Light::Kind::directional;
    scene.lights[0].direction = {0, -1, 0};
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        if (!technique.by_nature.empty()) continue;
        const Frame frame = render(technique, scene, Plan{}, gpu);
        const auto claim = [&](const glm::dvec3& point) {
            const Pixel pixel = pixel_of(scene, point);
            return frame.claim.at(pixel.x, pixel.y);
        };
        EXPECT_EQ(claim({0, 0, 0}), Visibility::shadowed) << technique.name;
        EXPECT_EQ(claim({0.95, 0, 0.95}), Visibility::shadowed) << technique.name;
        EXPECT_EQ(claim({1.3, 0, 1.3}), Visibility::lit) << technique.name;
        EXPECT_EQ(claim({0, 2, 0}), Visibility::lit) << technique.name;
    }
}

TEST(Render, refuses_a_picture_larger_than_the_driver_can_draw) {
    Scene scene = box_over_floor();
    scene.camera.width = 1 << 20;
    Gpu gpu(GlPlatform::osmesa);
    EXPECT_THROW(render(*find_technique("zpass"), scene, Plan{}, gpu), Error);
}

Frame broken_frame(const Scene& scene) {
    Frame frame;
    frame.claim = {scene.camera.width, scene.camera.height};
    frame.counted.emplace().counter = {scene.camera.width, scene.camera.height};
    frame.depth = {scene.camera.width, scene.camera.height};
    frame.triangle = {scene.camera.width, scene.camera.height, no_triangle};
    return frame;
}
Frame with_nan_depth(Gpu& /*gpu*/, const Scene& scene, const Plan& /*plan*/) {
    Frame frame = broken_frame(scene);
    frame.depth.at(3, 5) = std::numeric_limits<float>::quiet_NaN();
    return frame;
}
Frame with_unknown_triangle(Gpu& /*gpu*/, const Scene& scene, const Plan& /*plan*/) {
    Frame frame = broken_frame(scene);
    frame.triangle.at(3, 5) = static_cast<std::uint32_t>(scene.triangles.size());
    return frame;
}

TEST(Render, refuses_nan_depth_and_triangles_that_are_not_there) {
    const Scene scene = box_over_floor();
    Gpu gpu(GlPlatform::osmesa);
    Technique technique{.name = "broken",
                        .summary = "",
                        .source = "",
                        .needs = "",
                        .fails_at = {},
                        .run = with_nan_depth};
    EXPECT_THROW(render(technique, scene, Plan{}, gpu), Error);
    technique.run = with_unknown_triangle;
    EXPECT_THROW(render(technique, scene, Plan{}, gpu), Error);
}

TEST(Render, a_scene_without_triangles_is_all_background) {
    const Scene scene = empty_scene();
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        const Frame frame = render(technique, scene, Plan{}, gpu);
        EXPECT_EQ(frame.claim.pixels, Image<Visibility>(64, 64, Visibility::background).pixels);
    }
}

} // namespace
} // namespace shadowproof::tests
