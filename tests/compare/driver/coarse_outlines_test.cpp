// The clipper makes corners from others far away, in floats: what it may draw aside is explained,
// and no more than that.
#include "compare/driver/coarse_outlines.h"
#include "scenes/mesh/touching_light.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof::tests {
namespace {

/// A box over a floor that reaches so far to each side, seen from a man's height above it.
Scene box_over_wide_floor(float half_width) {
    Scene scene = box_over_floor();
    for (glm::vec3& position : scene.positions)
        if (std::abs(position.x) > 2) position *= glm::vec3(half_width / 10);
    look_at(scene.camera, {4, 8, 7}, {0, 1, 0});
    scene.camera.width = scene.camera.height = 40;
    return scene;
}

CoarseOutlines outlines_of(const TracedScene& traced, const Frame& frame) {
    return {traced.scene, &traced.silhouette, nullptr,
            drawing_of(traced.scene, frame.depth_model, std::numeric_limits<double>::infinity())};
}

TEST(CoarseOutlines, are_moved_by_three_roundings_of_the_far_corner) {
    Scene scene = empty_scene();
    Camera& camera = scene.camera;
    scene.lights[0].position = {0, 0, 9}; // behind the eye: no side comes into the picture
    const float far = 0x1p20F;
    // Seen at depth 4: a right edge from (0.5, 0) straight down to far below the picture.
    scene.positions = {{0.5F, 0, 1}, {0.5F, -far, 1}, {-far, 0, 1}};
    scene.triangles = {{0, 2, 1}};
    scene.meshes = {{"one", 0, 1, 0}};
    scene.materials = {{"plain", true}};
    const TracedScene traced(scene);
    Frame frame;
    frame.depth_model.projection = DepthModel::Projection::infinite_reversed;
    frame.depth_model.eye_relative = true;
    const CoarseOutlines outlines = outlines_of(traced, frame);
    // Clipped at the lower border of the picture: 3 v 2^20, half of which is left in the middle, at
    // 32 / 4 pixels a unit.
    const glm::dvec2 on = project(camera, {0.5, -2, 1});
    const double once = 3 * 0x1p-24 * far * 32 / 4;
    const auto is_reached = [&](double pixels) {
        return !outlines.places_across(on + glm::dvec2(pixels, 0), 0x1p-20, 32).empty();
    };
    EXPECT_TRUE(is_reached(0.4 * once));
    EXPECT_FALSE(is_reached(4 * once));
    for (const glm::dvec2& place : outlines.places_across(on + glm::dvec2(0.2 * once, 0), 0.01, 32))
        EXPECT_NEAR(std::abs(place.x - on.x), 0.01, 1e-4);
}

std::vector<PicturePoint> square(double error) {
    std::vector<PicturePoint> corners;
    for (const glm::dvec2& place :
         {glm::dvec2(0, 0), glm::dvec2(8, 0), glm::dvec2(8, 8), glm::dvec2(0, 8)})
        corners.push_back({.place = place, .place_error = error});
    return corners;
}

TEST(CertainlyHolds, a_place_is_held_as_long_as_no_corner_can_move_an_edge_over_it) {
    EXPECT_TRUE(certainly_holds(square(0.9), {1, 4}, 0));
    EXPECT_TRUE(certainly_holds(square(0.9), {4, 7}, 0));
    EXPECT_FALSE(certainly_holds(square(1.1), {1, 4}, 0));
    EXPECT_TRUE(certainly_holds(square(0.5), {1, 4}, 0.4));
    EXPECT_FALSE(certainly_holds(square(0.5), {1, 4}, 0.6));
    EXPECT_FALSE(certainly_holds(square(0), {-1, 4}, 0));
    EXPECT_FALSE(certainly_holds(square(NAN), {4, 4}, 0));
    std::vector<PicturePoint> other_way = square(0.9);
    std::ranges::reverse(other_way);
    EXPECT_TRUE(certainly_holds(other_way, {1, 4}, 0));
    EXPECT_FALSE(certainly_holds({other_way[0], other_way[1]}, {4, 4}, 0));
    // Half as far along an edge as its only uncertain corner.
    std::vector<PicturePoint> one = square(0);
    one[1].place_error = 4;
    EXPECT_TRUE(certainly_holds(one, {4, 2.5}, 0));
    EXPECT_FALSE(certainly_holds(one, {4, 1.5}, 0));
}

TEST(CoarseOutlines, are_none_where_nothing_is_clipped) {
    Scene scene = empty_scene();
    scene.lights[0].position = {0, 0, 9};
    scene.positions = {{0.5F, 0, 1}, {0.5F, -1, 1}, {-1, 0, 1}};
    scene.triangles = {{0, 2, 1}};
    scene.meshes = {{"one", 0, 1, 0}};
    scene.materials = {{"plain", true}};
    const TracedScene traced(scene);
    const CoarseOutlines outlines = outlines_of(traced, {});
    EXPECT_TRUE(outlines.places_across(project(scene.camera, {0.5, -0.5, 1}), 1, 32).empty());
}

TEST(WideFloor, is_explained) {
    Gpu gpu(GlPlatform::osmesa);
    for (const float half_width : {4e3F, 4e4F, 4e5F}) {
        const TracedScene traced(box_over_wide_floor(half_width));
        for (const char* name : {"zfail_reversed", "zfail_infinite", "zpass", "auto"}) {
            SCOPED_TRACE(testing::Message() << name << ", " << half_width);
            const Comparison comparison = compared(traced, name, gpu);
            EXPECT_EQ(comparison.evidence.unexplained, 0U);
            EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U);
        }
    }
}

/// A thousand kilometres under a light two metres above: the clipper, which cuts the floor's dark
/// cap at infinity, would be off by a part of the picture, did the cap not have a corner in its
/// middle.
TEST(WideFloor, keeps_its_dark_cap_over_all_of_the_picture) {
    Scene scene = box_over_wide_floor(2e6F);
    scene.lights.front().position = {-10.4, 2.2, 7.5};
    Gpu gpu(GlPlatform::osmesa);
    for (const int size : {32, 64, 100}) {
        scene.camera.width = scene.camera.height = size;
        const TracedScene traced(scene);
        ASSERT_FALSE(triangles_touching_light(scene).empty());
        const Frame frame =
            render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
        std::size_t lost = 0;
        for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
            lost += frame.claim.pixels[i] == Visibility::shadowed &&
                    traced.truth.visibility.pixels[i] == Visibility::lit;
        EXPECT_LT(lost, frame.claim.pixels.size() / 100) << size;
        EXPECT_EQ(compared(traced, frame).evidence.unexplained, 0U) << size;
    }
}

/// Lit pixels, one by one. Wider floors are themselves drawn at depths so far off that the volume
/// under them may come out in front.
TEST(WideFloor, excuses_no_false_shadow) {
    Gpu gpu(GlPlatform::osmesa);
    for (const float half_width : {4e3F, 1e4F}) {
        const TracedScene traced(box_over_wide_floor(half_width));
        for (const char* name : {"zfail_reversed", "zpass"}) {
            const Frame frame = render(*find_technique(name), traced.scene, traced.plan, gpu);
            const Image<std::uint8_t> before = compared(traced, frame).cause;
            int tried = 0;
            int excused = 0;
            for (int y = 0; y < 40; y += 3)
                for (int x = 0; x < 40; x += 3) {
                    if (frame.claim.at(x, y) != Visibility::lit || before.at(x, y) != no_difference)
                        continue;
                    Frame faulty = frame;
                    faulty.claim.at(x, y) = Visibility::shadowed;
                    faulty.counted->counter.at(x, y) = 1;
                    ++tried;
                    const auto cause = static_cast<Cause>(compared(traced, faulty).cause.at(x, y));
                    excused += cause == Cause::unexplained ? 0 : 1;
                }
            EXPECT_GT(tried, 50);
            EXPECT_EQ(excused, 0) << name << ", " << half_width;
        }
    }
}

/// Pixels of the floor that show nothing, one by one.
TEST(WideFloor, is_not_lost_where_the_clipper_holds_it) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(box_over_wide_floor(4e3F));
    for (const char* name : {"zfail_reversed", "zfail", "cube_map_six_pass"}) {
        const Frame frame = render(*find_technique(name), traced.scene, traced.plan, gpu);
        ASSERT_EQ(pixels_of(compared(traced, frame), Cause::unexplained), 0U);
        int tried = 0;
        for (int y = 1; y < 40; y += 4)
            for (int x = 1; x < 40; x += 4) {
                if (frame.triangle.at(x, y) == no_triangle) continue;
                Frame faulty = frame;
                faulty.triangle.at(x, y) = no_triangle;
                faulty.depth.at(x, y) = frame.depth_model.reversed() ? 0.0F : 1.0F;
                faulty.claim.at(x, y) = Visibility::background;
                ++tried;
                EXPECT_EQ(pixels_of(compared(traced, faulty), Cause::unexplained), 1U)
                    << name << " at " << x << ", " << y;
            }
        EXPECT_GT(tried, 30);
    }
}

TEST(WideFloor, excuses_no_picture_that_is_a_pixel_aside) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(box_over_wide_floor(4e3F));
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    Frame aside = frame;
    for (int y = 0; y < 40; ++y)
        for (int x = 1; x < 40; ++x) {
            aside.counted->counter.at(x, y) = frame.counted->counter.at(x - 1, y);
            aside.claim.at(x, y) = frame.claim.at(x - 1, y);
            aside.triangle.at(x, y) = frame.triangle.at(x - 1, y);
        }
    // All but those that happen to lie on an edge of their own.
    const Comparison comparison = compared(traced, aside);
    EXPECT_GT(comparison.differing, 10U);
    EXPECT_GT(2 * pixels_of(comparison, Cause::unexplained), comparison.differing);
}

} // namespace
} // namespace shadowproof::tests
