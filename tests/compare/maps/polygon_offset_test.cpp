// A slope bias and units, which are OpenGL's polygon offset: how far they move a surface is
// bounded, what they make wrong is named, and a map drawn with others than it says is caught.
#include "compare/evidence.h"
#include "compare/maps/polygon_offset.h"
#include "scenes/error.h"
#include "tests/compare/maps/drawn_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace shadowproof {
namespace {

using tests::compared;
using tests::drawn;
using tests::pixels_of;
using tests::small;
using tests::texels_not_shown;
using tests::TracedScene;

/// A triangle whose depth rises by 1/100 a texel to the right, and by 2/100 downwards.
std::vector<PicturePoint> tilted() {
    const auto at = [](double x, double y) {
        return PicturePoint{.place = {x, y}, .key = 0.1 + 0.01 * x + 0.02 * y};
    };
    return {at(0, 0), at(16, 0), at(0, 16)};
}

PolygonOffset slope_offset(const std::vector<PicturePoint>& polygon, double factor, double scale,
                           double reach, const glm::dvec2& place = {4, 4}) {
    MapModel model;
    model.slope_bias = factor;
    return polygon_offset(polygon, place, model, {}, {0, scale}, reach);
}

PolygonOffset offset_of(const std::vector<PicturePoint>& polygon, double units, MapFormat format) {
    MapModel model;
    model.offset_units = units;
    model.format = format;
    return polygon_offset(polygon, {4, 4}, model, {0x1p-23, 0x1.001p-23}, {0, 1}, 0);
}

TEST(OffsetUnits, are_steps_of_the_format_and_of_floats_those_at_the_largest_depth) {
    // Its depths are 0.1, 0.26 and 0.42.
    EXPECT_EQ(offset_of(tilted(), 3, MapFormat::d32f).own, 3 * 0x1p-25);
    EXPECT_EQ(offset_of(tilted(), 1, MapFormat::d24).own, 0x1.0008p-23);
    EXPECT_EQ(offset_of(tilted(), 0, MapFormat::d24).most, 0);
    for (const MapFormat format : all_map_formats) {
        const PolygonOffset offset = offset_of(tilted(), 7, format);
        EXPECT_LE(offset.least, offset.own);
        EXPECT_GE(offset.most, offset.own);
        EXPECT_LT(offset.most, 1.001 * offset.least);
    }
    // Next to a power of two either exponent may be taken.
    std::vector<PicturePoint> border = tilted();
    border[2].key = 0.5;
    border[2].depth_error = 1e-7;
    EXPECT_EQ(offset_of(border, 1, MapFormat::d32f).own, 0x1p-24);
    EXPECT_LT(offset_of(border, 1, MapFormat::d32f).least, 0x1.01p-25);
}

TEST(SlopeOffset, is_the_factor_times_the_larger_slope_and_at_most_the_gradient) {
    const PolygonOffset exact = slope_offset(tilted(), 3, 1, 0);
    EXPECT_NEAR(exact.own, 0.06, 1e-9);
    EXPECT_NEAR(exact.least, 0.06, 1e-6);
    EXPECT_NEAR(exact.most, 3 * std::hypot(0.01, 0.02), 1e-6);
    EXPECT_LE(exact.least, exact.own);
    EXPECT_NEAR(slope_offset(tilted(), 3, 0.5, 0).own, 0.03, 1e-9);
    EXPECT_EQ(slope_offset(tilted(), 0, 1, 0).most, 0);
}

TEST(SlopeOffset, is_looser_where_corners_are_snapped_and_unbounded_where_there_is_no_area) {
    const PolygonOffset exact = slope_offset(tilted(), 3, 1, 0);
    const PolygonOffset snapped = slope_offset(tilted(), 3, 1, 0x1p-9);
    EXPECT_LT(snapped.least, exact.least);
    EXPECT_GT(snapped.most, exact.most);
    // Corners that move by 1/512 of a texel change a slope over 16 texels by less than a hundredth.
    EXPECT_GT(snapped.least, 0.99 * exact.least);
    EXPECT_LT(snapped.most, 1.01 * exact.most);
    std::vector<PicturePoint> edge_on = tilted();
    edge_on[2].place = {8, 0};
    EXPECT_TRUE(std::isinf(slope_offset(edge_on, 3, 1, 0x1p-9).most));
}

TEST(SlopeOffset, is_that_of_the_triangle_which_covers_the_texel) {
    // A border has cut off a corner: what is left is drawn as two triangles, of which the second is
    // a tenth of a texel high at most, and its slope is told from a depth over this height.
    const auto at = [](double x, double y) {
        return PicturePoint{.place = {x, y}, .key = 0.1 + 0.01 * y, .depth_error = 0x1p-20};
    };
    const std::vector<PicturePoint> polygon{at(0, 10), at(40, 0), at(40, 20), at(0, 10.1)};
    const PolygonOffset large = slope_offset(polygon, 1, 1, 0, {30, 10});
    const PolygonOffset thin = slope_offset(polygon, 1, 1, 0, {2, 10.5});
    EXPECT_NEAR(large.own, 0.01, 1e-12);
    EXPECT_EQ(thin.own, large.own);
    EXPECT_GT(large.least, 0.0099);
    EXPECT_LT(large.most, 0.0101);
    EXPECT_LT(thin.least, 0.00999);
    EXPECT_GT(thin.most, 0.01001);
    EXPECT_LT(thin.most - thin.least, 0.001);
    const PolygonOffset beside = slope_offset(polygon, 1, 1, 0, {20, 40});
    EXPECT_EQ(beside.least, std::min(thin.least, large.least)) << "where none covers it, any may";
}

/// The technique for a scene's light, with maps of depths.
struct SlopedCase {
    const char* scene;
    const char* technique;
};

class SlopeBias : public testing::TestWithParam<SlopedCase> {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene traced{small(GetParam().scene)};

    Frame sloped(double slope_bias, double bias, double units = 0,
                 std::optional<MapFormat> format = {}, std::optional<double> near = {},
                 int size = 256) {
        return drawn(gpu, traced, GetParam().technique,
                     {.size = size,
                      .bias = bias,
                      .slope_bias = slope_bias,
                      .offset_units = units,
                      .value = MapValue::depth,
                      .format = format,
                      .near = near});
    }
};

TEST_P(SlopeBias, of_units_is_predicted_for_each_format_and_others_are_caught) {
    for (const MapFormat format : all_map_formats)
        for (const double slope_bias : {0.0, 1.1}) {
            // So many that a tenth of them is more than the bounds of depths, and 1 is not reached.
            const double units =
                format == MapFormat::d16 ? 40 : (format == MapFormat::d24 ? 2e4 : 1e5);
            SCOPED_TRACE(testing::Message() << name_of(format) << ", " << slope_bias);
            // In perspective window depths are next to 1 but for a near plane far from the light.
            const bool is_sun = std::string_view(GetParam().technique) == "sun_map";
            Frame frame = sloped(slope_bias, 0.001, units, format,
                                 is_sun ? std::nullopt : std::optional(1.0), 96);
            EXPECT_EQ(texels_not_shown(traced, frame), 0U);
            EXPECT_TRUE(is_explained(compared(traced, frame)));
            for (const double share : {0.9, 1.1}) {
                frame.mapped->model.offset_units = share * units;
                EXPECT_GT(texels_not_shown(traced, frame), 0U) << share;
            }
        }
}

TEST_P(SlopeBias, of_many_units_mends_acne) {
    EXPECT_GT(pixels_of(compared(traced, sloped(0, 0)), Cause::acne), 100U);
    const Comparison moved = compared(traced, sloped(0, 0, 1e6));
    EXPECT_LT(pixels_of(moved, Cause::acne),
              pixels_of(compared(traced, sloped(0, 0)), Cause::acne));
}

TEST_P(SlopeBias, of_any_size_leaves_no_texel_and_no_pixel_unexplained) {
    for (const double slope_bias : {0.25, 1.1, 4.0, 40.0}) {
        const Frame frame = sloped(slope_bias, 0.001);
        EXPECT_EQ(texels_not_shown(traced, frame), 0U) << slope_bias;
        EXPECT_TRUE(is_explained(compared(traced, frame))) << slope_bias;
    }
}

TEST_P(SlopeBias, mends_acne_and_makes_leaks) {
    const Comparison without = compared(traced, sloped(0, 0.002));
    const Comparison some = compared(traced, sloped(2, 0.002));
    const Comparison much = compared(traced, sloped(100, 0.002));
    EXPECT_GT(pixels_of(without, Cause::acne), 100U);
    EXPECT_LT(pixels_of(some, Cause::acne), pixels_of(without, Cause::acne) / 10);
    EXPECT_GT(pixels_of(much, Cause::leak), pixels_of(some, Cause::leak));
}

TEST_P(SlopeBias, that_is_another_than_the_map_says_is_caught) {
    const auto is_caught = [&](double drawn_with, double said) {
        Frame frame = sloped(drawn_with, 0.01);
        frame.mapped->model.slope_bias = said;
        return texels_not_shown(traced, frame) > 0 && !is_explained(compared(traced, frame));
    };
    EXPECT_FALSE(is_caught(2, 2));
    EXPECT_TRUE(is_caught(2, 0));
    EXPECT_TRUE(is_caught(2, 1));
    EXPECT_TRUE(is_caught(0, 2));
    // Either the larger slope counts or the gradient, which is up to 1.42 times as much.
    EXPECT_TRUE(is_caught(2, 3));
}

/// One corner of the floor's triangles lies just beside the picture of a face, whose border cuts it
/// off: the second triangle that is left is a tenth of a texel high at most, and its slope comes
/// out some per cent wrong.
TEST(SlopeBiasAtBorders, is_explained_where_a_border_leaves_a_thin_triangle) {
    Scene scene = small("far_light", 200);
    scene.lights[0].position = {-3.32059, 2.85021, -3.37865};
    const TracedScene traced(std::move(scene));
    Gpu gpu(GlPlatform::osmesa);
    Frame frame = drawn(gpu, traced, "cube_map_six_pass",
                        {.size = 513, .bias = 0.001, .slope_bias = 3, .value = MapValue::depth});
    EXPECT_EQ(texels_not_shown(traced, frame), 0U);
    EXPECT_TRUE(is_explained(compared(traced, frame)));
    // The offset is 3.94e-5, of which 2e-6 are missing in the thin triangle. Its corners' depths
    // are off by 1.3e-6 each, over 0.08 of a texel: 1.4e-4 is the most it may have.
    float& thin = frame.mapped->faces[0].at(180, 34);
    float& beside = frame.mapped->faces[0].at(184, 34);
    for (float* stored : {&thin, &beside}) {
        const float right = *stored;
        *stored = right + (stored == &thin ? 1.1e-4F : 3e-6F);
        EXPECT_EQ(texels_not_shown(traced, frame), 1U) << (stored == &thin);
        *stored = right;
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, SlopeBias,
                         testing::Values(SlopedCase{"sun", "sun_map"},
                                         SlopedCase{"spot", "spot_map"},
                                         SlopedCase{"ordinary", "cube_map_six_pass"}),
                         [](const auto& each) { return std::string(each.param.technique); });

TEST(SlopeBiasOfDistances, is_refused) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene ordinary(small("ordinary", 16));
    EXPECT_THROW(drawn(gpu, ordinary, "cube_map_six_pass", {.slope_bias = 1}), Error);
    EXPECT_THROW(drawn(gpu, ordinary, "cube_map_six_pass", {.offset_units = 1}), Error);
    EXPECT_NO_THROW(drawn(gpu, ordinary, "cube_map_six_pass",
                          {.size = 16, .slope_bias = 1, .value = MapValue::depth}));
}

/// Which triangles are left depends on the order of corners in which a caster is drawn, whichever
/// of its sides is. Found among 400 random lights.
TEST(SlopeBiasAtBorders, is_explained_where_fronts_are_culled) {
    Gpu gpu(GlPlatform::osmesa);
    for (const glm::dvec3 light :
         {glm::dvec3(4.58633, 1.71613, 4.50123), glm::dvec3(-3.14496, 1.63520, -3.17315),
          glm::dvec3(4.30689, 1.47570, 4.23649), glm::dvec3(-1.48835, 2.93924, 0.97579)}) {
        Scene scene = small("far_light", 16);
        scene.lights[0].position = light;
        for (glm::uvec3& corners : scene.triangles) std::swap(corners.y, corners.z);
        const TracedScene traced(std::move(scene));
        const Frame frame = drawn(gpu, traced, "cube_map_six_pass",
                                  {.size = 257,
                                   .bias = 0.001,
                                   .slope_bias = 3,
                                   .value = MapValue::depth,
                                   .culling = MapCulling::front});
        EXPECT_EQ(texels_not_shown(traced, frame), 0U) << light.x;
    }
}

} // namespace
} // namespace shadowproof
