// Logarithms and powers of the shaders (powers.glsl), measured on the driver against their bounds
// (powers_range.h).
#include "compare/driver/lighting/powers_range.h"
#include "raster/gl/context.h"
#include "raster/gl/shader.h"
#include "tests/raster/drawn_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof::tests {
namespace {

constexpr int side = 4096;

/// What a GLSL expression makes of the number x whose bits are `first` and the pixel's number times
/// `step` more, pixel by pixel.
std::vector<float> results_of(const std::string& expression, std::uint32_t first,
                              std::uint32_t step) {
    const Gpu gpu(GlPlatform::osmesa);
    const GlFunctions& gl = gpu.gl();
    const Picture picture = make_picture(gl, GL_R32F, side, side);
    draw_pixels(gl, picture,
                std::string(glsl_source("powers.glsl")) +
                    "layout(location = 0) out float result;\n"
                    "void main() {\n"
                    "    uvec2 at = uvec2(gl_FragCoord.xy);\n"
                    "    float x = uintBitsToFloat(" +
                    std::to_string(first) + "u + " + std::to_string(step) +
                    "u * (4096u * at.y + at.x));\n    result = " + expression + ";\n}\n");
    std::vector<float> results(std::size_t{side} * side);
    gl.ReadPixels(0, 0, side, side, GL_RED, GL_FLOAT, results.data());
    return results;
}

double number_of(std::uint32_t first, std::uint32_t step, std::size_t i) {
    return std::bit_cast<float>(first + step * static_cast<std::uint32_t>(i));
}

/// All mantissas of the binades from a half to 2, and every 41st number of those from 2^-80.
TEST(Powers, of_logarithms_are_within_their_bound) {
    for (const auto& [first, step] : {std::pair{0x3f000000U, 1U}, std::pair{0x17800000U, 41U}}) {
        const std::vector<float> found = results_of("log2_of(x)", first, step);
        double worst = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double right = std::log2(number_of(first, step, i));
            worst = std::max(worst, std::abs(found[i] - right) / log2_error(right));
        }
        EXPECT_LE(worst, 1) << step;
        EXPECT_GT(worst, 0.1) << step; // nor far off
    }
}

TEST(Powers, of_two_are_within_their_bound) {
    // From -128 to -2^-63, and to 64.
    for (const auto& [first, step] : {std::pair{0xa0000000U, 35U}, std::pair{0x20000000U, 34U}}) {
        const std::vector<float> found = results_of("exp2_of(x)", first, step);
        double worst = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double x = number_of(first, step, i);
            if (x > 64 || x < -128) continue;
            if (x < least_exponent)
                EXPECT_EQ(found[i], 0) << x;
            else
                worst = std::max(worst, std::abs(found[i] / std::exp2(x) - 1) / exp2_error);
        }
        EXPECT_LE(worst, 1) << step;
        EXPECT_GT(worst, 0.1) << step;
    }
}

TEST(Powers, are_within_their_range) {
    // From 2^-41 to 1.
    constexpr std::uint32_t first = 0x2b000000;
    constexpr std::uint32_t step = 20;
    for (const double y : {0.0, 0.013, 0.7, 1.0, 7.9, 128.0}) {
        const auto float_y = static_cast<float>(y);
        const std::vector<float> found =
            results_of("power_of(x, " + std::to_string(y) + ")", first, step);
        int outside = 0;
        double widest = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double x = number_of(first, step, i);
            if (x > 1) break;
            const Interval range = power_range(around(x), around(double{float_y}));
            outside += range.contains(found[i]) ? 0 : 1;
            widest = std::max(widest, range.high - range.low);
        }
        EXPECT_EQ(outside, 0) << y;
        EXPECT_LT(widest, 1e-5) << y; // says something
    }
}

TEST(Powers, of_nothing_are_nothing) {
    for (const char* base : {"0", "-1", "1e-40"})
        EXPECT_EQ(results_of("power_of(" + std::string(base) + ", 2)", 0, 0)[0], 0) << base;
}

} // namespace
} // namespace shadowproof::tests
