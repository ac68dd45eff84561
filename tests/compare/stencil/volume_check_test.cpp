// The figures of volumes: predicted from the faces that a technique draws, and wrong ones caught.
#include "compare/driver/pictured_face.h"
#include "compare/stencil/figures/drawn_faces.h"
#include "compare/stencil/figures/drawn_picture.h"
#include "compare/stencil/figures/volume_check.h"
#include "scenes/load/catalog.h"
#include "scenes/stress/parameter.h"
#include "tests/compare/traced_scene.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace shadowproof {
namespace {

using tests::TracedScene;

Scene small(const char* name, int width = 160, int height = 120) {
    Scene scene = tests::load_named(name);
    scene.camera.width = width;
    scene.camera.height = height;
    return scene;
}

VolumeCheck checked(const TracedScene& traced, const Frame& frame) {
    const Volumes volumes(traced.tracer, traced.silhouette, frame.counted->counting);
    return check_volumes(traced.tracer, traced.silhouette, volumes, frame, traced.depths.far);
}

/// Where it is free whether a face covers a pixel: an outline of the face passes within a pixel of
/// the centre, or as near as its corners may be drawn aside. How many fragments those are, of all
/// faces.
std::uint64_t free_fragments(const TracedScene& traced, const Frame& frame) {
    const Volumes volumes(traced.tracer, traced.silhouette, frame.counted->counting);
    const DrawnFaces drawn =
        drawn_faces(volumes, frame.counted->counting, frame.counted->volume_faces);
    const DrawnPicture picture{volumes.drawn_casters(), volumes.far_ends(), drawn, frame,
                               traced.depths.far};
    const PicturedFaces faces(picture);
    const Camera& camera = traced.scene.camera;
    std::uint64_t free = 0;
    int strays = 0;
    for (std::size_t i = 0; i < faces.count(); ++i) {
        const PicturedFace face = faces.face(i);
        const double reach = std::max(1.0, face.margin);
        for (int y = 0; y < camera.height; ++y) {
            const PixelRun possible = face.possible.row(y, camera.width);
            for (int x = possible.first; x < possible.end; ++x) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                if (face.certain.holds(centre)) continue;
                free += face.copies;
                bool at_outline = false;
                for (const glm::dvec2& way :
                     {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(-1, 0), glm::dvec2(0, -1),
                      glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(-1, -1), glm::dvec2(1, -1)})
                    at_outline = at_outline || !face.possible.holds(centre + reach * way);
                strays += at_outline ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(strays, 0);
    return free;
}

/// Lines around faces are free, and nothing else.
void expect_narrow(const TracedScene& traced, const Frame& frame, const FigureRange& range) {
    EXPECT_LE(range.high - range.low, free_fragments(traced, frame));
}

std::vector<PicturePoint> points(std::initializer_list<glm::dvec2> places) {
    std::vector<PicturePoint> polygon;
    for (const glm::dvec2& place : places) polygon.push_back({.place = place});
    return polygon;
}

/// Centres held, counted one by one.
int pixels_of(const ConvexRegion& region, int width, int height) {
    int pixels = 0;
    const PixelRun rows = region.rows(height);
    for (int y = rows.first; y < rows.end; ++y) pixels += region.row(y, width).length();
    return pixels;
}

TEST(ConvexRegion, a_square_on_the_pixels_corners_holds_its_pixels_whatever_the_margin) {
    const auto square = points({{2, 3}, {6, 3}, {6, 8}, {2, 8}});
    for (const double margin : {0.0, 0.25, 0.499, -0.25, -0.499})
        EXPECT_EQ(pixels_of(ConvexRegion(square, margin), 10, 10), 4 * 5) << margin;
    EXPECT_EQ(pixels_of(ConvexRegion(square, 0.51), 10, 10), 2 * 3);
    EXPECT_EQ(pixels_of(ConvexRegion(square, -0.51), 10, 10), 6 * 7);
}

TEST(ConvexRegion, the_way_round_does_not_matter) {
    const auto there = points({{1, 1}, {8.2, 2.1}, {4.3, 9.7}});
    const auto back = points({{4.3, 9.7}, {8.2, 2.1}, {1, 1}});
    for (const double margin : {0.2, -0.2})
        EXPECT_EQ(pixels_of(ConvexRegion(there, margin), 10, 10),
                  pixels_of(ConvexRegion(back, margin), 10, 10));
}

TEST(ConvexRegion, a_polygon_without_an_area_holds_nothing_for_certain_and_its_line_perhaps) {
    const auto line = points({{0.5, 0.5}, {5.5, 5.5}, {3.5, 3.5}});
    EXPECT_EQ(pixels_of(ConvexRegion(line, 0.01), 10, 10), 0);
    EXPECT_EQ(pixels_of(ConvexRegion(line, -0.01), 10, 10), 6);
}

TEST(ConvexRegion, no_points_no_region_and_everywhere_is_the_picture) {
    EXPECT_EQ(pixels_of(ConvexRegion({}, -1), 7, 5), 0);
    EXPECT_EQ(pixels_of(ConvexRegion(), 7, 5), 0);
    EXPECT_EQ(pixels_of(ConvexRegion::everywhere(), 7, 5), 35);
}

class VolumesOfScene : public testing::TestWithParam<const char*> {};

TEST_P(VolumesOfScene, what_every_technique_shows_of_them_is_predicted_and_little_else) {
    const TracedScene traced(small(GetParam()));
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, traced.scene)) continue;
        SCOPED_TRACE(technique.name);
        const Frame frame = render(technique, traced.scene, traced.plan, gpu);
        if (!frame.counted) continue;
        const VolumeCheck check = checked(traced, frame);
        EXPECT_TRUE(check.holds()) << words_of(check);
        EXPECT_EQ(check.checked, frame.claim.pixels.size());
        expect_narrow(traced, frame, check.fragments.predicted);
        EXPECT_EQ(check.against.has_value(), technique.name == "auto");
    }
}
INSTANTIATE_TEST_SUITE_P(Bundled, VolumesOfScene,
                         testing::Values("near_plane", "near_cap_some", "light_inside", "far_cut",
                                         "open_lid", "sun", "idle_casters", "non_manifold"),
                         [](const auto& test) { return std::string(test.param); });

TEST(VolumeCheck, a_figure_just_outside_the_range_is_caught_and_said) {
    const TracedScene traced(small("near_plane"));
    Gpu gpu(GlPlatform::osmesa);
    Frame frame = render(*find_technique("zfail"), traced.scene, traced.plan, gpu);
    const FigureRange range = checked(traced, frame).fragments.predicted;
    for (const std::uint64_t figure : {range.low, range.high}) {
        frame.counted->volume_fragments = figure;
        EXPECT_TRUE(checked(traced, frame).holds());
    }
    for (const std::uint64_t figure : {range.low - 1, range.high + 1}) {
        frame.counted->volume_fragments = figure;
        const VolumeCheck check = checked(traced, frame);
        EXPECT_FALSE(check.holds());
        EXPECT_TRUE(words_of(check).starts_with("volume_fragments ")) << words_of(check);
    }
}

TEST(VolumeCheck, a_saving_that_does_not_add_up_is_caught) {
    const TracedScene traced(small("near_plane"));
    Gpu gpu(GlPlatform::osmesa);
    Frame frame = render(*find_technique("auto"), traced.scene, traced.plan, gpu);
    ASSERT_TRUE(checked(traced, frame).holds());
    frame.counted->saved->volume_fragments *= 2;
    EXPECT_FALSE(checked(traced, frame).holds());
    frame.counted->saved->volume_fragments =
        -1 - static_cast<std::int64_t>(frame.counted->volume_fragments);
    EXPECT_FALSE(checked(traced, frame).holds()) << "less than nothing was drawn";
}

TEST(VolumeCheck, a_picture_that_is_empty_or_missing_or_another_is_caught) {
    const TracedScene traced(small("near_plane"));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail"), traced.scene, traced.plan, gpu);
    Frame faulty = frame;
    faulty.counted->volumes = {};
    EXPECT_EQ(checked(traced, faulty).unexplained, frame.claim.pixels.size());
    faulty.counted->volumes =
        Image<std::uint8_t>(frame.counted->volumes.width, frame.counted->volumes.height);
    EXPECT_GT(checked(traced, faulty).unexplained, frame.claim.pixels.size() / 10);
    faulty.counted->volumes = converted<std::uint8_t>(
        frame.counted->counter, [](std::uint32_t n) { return std::uint8_t(n); });
    EXPECT_GT(checked(traced, faulty).unexplained, frame.claim.pixels.size() / 10);
    faulty.counted->volumes = frame.counted->volumes;
    std::reverse(faulty.counted->volumes.pixels.begin(), faulty.counted->volumes.pixels.end());
    EXPECT_FALSE(checked(traced, faulty).holds());
}

/// Of nearly all pixels the number of faces is known: one more, or one less, is caught.
TEST(VolumeCheck, one_face_too_many_or_missing_is_caught_at_nearly_every_pixel) {
    const TracedScene traced(small("near_cap_some", 320, 240));
    Gpu gpu(GlPlatform::osmesa);
    for (const char* technique : {"zpass", "zpass_capped", "zp_plus", "zfail_reversed"}) {
        SCOPED_TRACE(technique);
        const Frame frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
        for (const int change : {-1, 1}) {
            Frame faulty = frame;
            std::uint64_t changed = 0;
            for (std::uint8_t& faces : faulty.counted->volumes.pixels) {
                if (faces == 0 && change < 0) continue;
                faces = static_cast<std::uint8_t>(faces + change);
                ++changed;
            }
            const VolumeCheck check = checked(traced, faulty);
            EXPECT_GT(check.unexplained, changed / 10 * 9) << "of " << changed;
            EXPECT_NE(words_of(check).find("picture of the volumes unexplained at"),
                      std::string::npos);
        }
    }
}

/// Copies of a face are pictured once and counted as often as they are drawn.
TEST(VolumeCheck, of_triangles_that_are_there_three_times_each_copy_counts) {
    const TracedScene traced(
        stressed(small("near_plane"), {.parameter = "coincident_faces", .value = 3}));
    Gpu gpu(GlPlatform::osmesa);
    for (const char* technique : {"zpass", "zfail", "zfail_reversed", "zfail_per_triangle"}) {
        SCOPED_TRACE(technique);
        Frame frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
        const VolumeCheck check = checked(traced, frame);
        EXPECT_TRUE(check.holds()) << words_of(check);
        expect_narrow(traced, frame, check.fragments.predicted);
        frame.counted->volume_fragments = frame.counted->volume_fragments / 3 * 2;
        EXPECT_FALSE(checked(traced, frame).fragments.holds());
    }
}

TEST(VolumeCheck, threads_change_nothing) {
    const TracedScene traced(small("nested"));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("auto"), traced.scene, traced.plan, gpu);
    const auto with = [&](int threads) {
        const Tracer tracer(traced.scene, threads);
        const Silhouette silhouette(tracer);
        const Volumes volumes(tracer, silhouette, frame.counted->counting);
        const VolumeCheck check =
            check_volumes(tracer, silhouette, volumes, frame, traced.depths.far);
        return std::array{check.fragments.predicted.low, check.fragments.predicted.high,
                          check.against->predicted.low, check.against->predicted.high,
                          check.unexplained};
    };
    EXPECT_EQ(with(1), with(3));
}

} // namespace
} // namespace shadowproof
