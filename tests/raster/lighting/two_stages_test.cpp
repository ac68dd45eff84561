// The passes of two register combiners of two_stages.glsl against what is worked out by hand.
#include "tests/raster/drawn_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace shadowproof::tests {
namespace {

constexpr double float_rounding = 1e-4; // steps

double steps_of(const std::string& expression) {
    return red_steps_of(expression, "two_stages.glsl");
}

// N' and L are (1, 1, 255) / 255: their product is 1 in a register.
TEST(TwoCombiners, of_the_diffuse_pass_add_light_overhead_to_the_ambient_light_and_clamp) {
    EXPECT_NEAR(steps_of("diffuse_pass(z, z, vec3(0.4), vec3(0.2))"), 102 + 51, float_rounding);
    EXPECT_NEAR(steps_of("diffuse_pass(z, z, vec3(0.8), vec3(0.4))"), 255, float_rounding);
    EXPECT_NEAR(steps_of("diffuse_pass(z, -z, vec3(0.8), vec3(0.4))"), 102, float_rounding);
}

// L is (1, 1, 13) / 255, so N'.L is 13 steps and its self-shadowing 104: 5.3 and so 5 steps, which
// the light of 0.4 makes 2.
TEST(TwoCombiners, of_the_diffuse_pass_dim_what_the_light_grazes) {
    EXPECT_NEAR(steps_of("diffuse_pass(z, vec3(0, 0, 0.05), vec3(0.4), vec3(0.2))"), 51 + 2,
                float_rounding);
}

// N' is (1, 1, 255) / 255, H (1, 181, 179) / 255: their product is 180 steps. The combiners square
// it three times, and round each time.
TEST(TwoCombiners, of_the_specular_pass_raise_to_the_eighth_power_and_take_colour_and_gloss) {
    const double squared = std::round(180 * 180 / 255.0);
    const double fourth = std::round(squared * squared / 255);
    const double eighth = std::round(fourth * fourth / 255);
    EXPECT_EQ(squared, 127);
    EXPECT_EQ(eighth, 16);
    const double shine = std::round(204 * eighth / 255);
    const std::string leaning = "specular_pass(vec3(0, 0, 1), vec3(0, 0.712, 0.702), vec3(0.8), ";
    EXPECT_NEAR(steps_of(leaning + "1)"), shine, float_rounding);
    EXPECT_NEAR(steps_of(leaning + "0.2)"), shine / 5, float_rounding);
}

// H is (1, 1, 13) / 255, and so is N', stretched until their product is 1: H's self-shadowing of
// 104 steps is what is left.
TEST(TwoCombiners, of_the_specular_pass_dim_by_the_half_angle_vectors_self_shadowing) {
    EXPECT_NEAR(steps_of("specular_pass(vec3(1, 1, 0.05), vec3(1, 1, 0.05), vec3(1), 1)"), 104,
                float_rounding);
    EXPECT_NEAR(steps_of("specular_pass(z, -z, vec3(1), 1)"), 0, float_rounding);
}

} // namespace
} // namespace shadowproof::tests
