// The register combiners of four_stages.glsl against what is worked out by hand.
#include "tests/raster/drawn_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace shadowproof::tests {
namespace {

/// In steps of 1/255; normal and half-angle vector are (0, 0, 1), the decal is 0.5 (128 steps) with
/// a gloss of 1, the light 1, the specular light 0.2 (51 steps), the ambient light 0.4 (102 steps).
double combined_steps(const std::string& to_light) {
    return red_steps_of("combined(z, " + to_light +
                            ", z, vec4(vec3(0.5), 1), vec3(1), vec3(0.2), vec3(0.4))",
                        "four_stages.glsl");
}

constexpr double float_rounding = 1e-4; // steps

// N', L and H are (1, 1, 255) / 255: their products, 1 and a little, are 1 in a register.
TEST(RegisterCombiners, add_up_to_ambient_and_decal_and_highlight_under_a_light_overhead) {
    const double ambient = std::round(102 * 128 / 255.0); // 51
    EXPECT_NEAR(combined_steps("z"), ambient + 128 + 51, float_rounding);
}

// L is (1, 1, 13) / 255, so N'.L is 13 steps and its self-shadowing 104. The product is 5.3 and so
// 5 steps, times the decal 2.5 and so 3; the highlight's 51 steps, times 104, are 20.8 and so 21.
TEST(RegisterCombiners, multiply_the_highlight_by_the_self_shadowing_of_a_grazing_light) {
    EXPECT_NEAR(combined_steps("vec3(0, 0, 0.05)"), 51 + 3 + 21, float_rounding);
}

TEST(RegisterCombiners, leave_ambient_light_alone_where_the_light_is_behind) {
    EXPECT_NEAR(combined_steps("-z"), 51, float_rounding);
}

} // namespace
} // namespace shadowproof::tests
