// A slope bias, which is OpenGL's polygon offset: how far it moves a surface is bounded, what it
// makes wrong is named, and a map drawn with another one than it says is caught.
#include "compare/evidence.h"
#include "compare/maps/slope_offset.h"
#include "scenes/error.h"
#include "tests/compare/maps/drawn_map.h"

#include <gtest/gtest.h>

#include <cmath>

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
        return PicturePoint{.place = {x, y}, .inverse_depth = 0.1 + 0.01 * x + 0.02 * y};
    };
    return {at(0, 0), at(16, 0), at(0, 16)};
}

TEST(SlopeOffset, is_the_factor_times_the_larger_slope_and_at_most_the_gradient) {
    const SlopeOffset exact = slope_offset(tilted(), 3, 1, 0);
    EXPECT_NEAR(exact.own, 0.06, 1e-9);
    EXPECT_NEAR(exact.least, 0.06, 1e-6);
    EXPECT_NEAR(exact.most, 3 * std::hypot(0.01, 0.02), 1e-6);
    EXPECT_LE(exact.least, exact.own);
    EXPECT_NEAR(slope_offset(tilted(), 3, 0.5, 0).own, 0.03, 1e-9);
    EXPECT_EQ(slope_offset(tilted(), 0, 1, 0).most, 0);
}

TEST(SlopeOffset, is_looser_where_corners_are_snapped_and_unbounded_where_there_is_no_area) {
    const SlopeOffset exact = slope_offset(tilted(), 3, 1, 0);
    const SlopeOffset snapped = slope_offset(tilted(), 3, 1, 0x1p-9);
    EXPECT_LT(snapped.least, exact.least);
    EXPECT_GT(snapped.most, exact.most);
    // Corners that move by 1/512 of a texel change a slope over 16 texels by less than a hundredth.
    EXPECT_GT(snapped.least, 0.99 * exact.least);
    EXPECT_LT(snapped.most, 1.01 * exact.most);
    std::vector<PicturePoint> edge_on = tilted();
    edge_on[2].place = {8, 0};
    EXPECT_TRUE(std::isinf(slope_offset(edge_on, 3, 1, 0x1p-9).most));
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

    Frame sloped(double slope_bias, double bias) {
        return drawn(
            gpu, traced, GetParam().technique,
            {.size = 256, .bias = bias, .slope_bias = slope_bias, .value = MapValue::depth});
    }
};

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

INSTANTIATE_TEST_SUITE_P(Lights, SlopeBias,
                         testing::Values(SlopedCase{"sun", "sun_map"},
                                         SlopedCase{"spot", "spot_map"},
                                         SlopedCase{"ordinary", "cube_map_six_pass"}),
                         [](const auto& each) { return std::string(each.param.technique); });

TEST(SlopeBiasOfDistances, is_refused) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene ordinary(small("ordinary", 16));
    EXPECT_THROW(drawn(gpu, ordinary, "cube_map_six_pass", {.slope_bias = 1}), Error);
    EXPECT_NO_THROW(drawn(gpu, ordinary, "cube_map_six_pass",
                          {.size = 16, .slope_bias = 1, .value = MapValue::depth}));
}

} // namespace
} // namespace shadowproof
