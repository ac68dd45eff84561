// How the shaders normalise vectors (normalise.glsl), measured on the driver.
#include "raster/gl/context.h"
#include "raster/gl/shader.h"
#include "raster/lighting/lighting.h"
#include "scenes/lighting_settings.h"
#include "scenes/surface/normalisation_cube.h"
#include "tests/raster/drawn_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace shadowproof::tests {
namespace {

/// normalise.glsl and the main function of a fragment shader.
std::string with_normalise(const std::string& main, int newton_steps = 1) {
    return "const int normalisation = 0;\nconst int newton_steps = " +
           std::to_string(newton_steps) + ";\n" + std::string(glsl_source("normalise.glsl")) + main;
}

/// The directions that a shader makes of a pixel's place: x and y run over a face, six rows after
/// one another over the six faces, in steps of 2039/65536 of a texel of 64 a side. All are floats.
constexpr int side = 2046;
constexpr const char* direction_of_pixel =
    "layout(location = 0) out vec4 result;\n"
    "vec3 direction() {\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    vec2 place = vec2(at.x - 1023, at.y / 6 * 6 - 1023) * (2039.0 / 2097152);\n"
    "    int face = at.y % 6;\n"
    "    float sign = face % 2 == 0 ? 1 : -1;\n"
    "    if (face < 2) return vec3(sign, place);\n"
    "    return face < 4 ? vec3(place.x, sign, place.y) : vec3(place, sign);\n"
    "}\n";

glm::dvec3 direction(int x, int y) {
    const glm::dvec2 place = 2039.0 / 2097152 * glm::dvec2(x - 1023, y / 6 * 6 - 1023);
    const int face = y % 6;
    const double sign = face % 2 == 0 ? 1 : -1;
    if (face < 2) return {sign, place.x, place.y};
    return face < 4 ? glm::dvec3(place.x, sign, place.y) : glm::dvec3(place, sign);
}

TEST(NormalisationCube, a_lookup_by_opengl_is_what_is_meant) {
    const Gpu gpu(GlPlatform::osmesa);
    const GlFunctions& gl = gpu.gl();
    for (const int size : {2, 16, 64, 512}) {
        const NormalisationCube cube = make_normalisation_cube(size);
        const Texture texture = upload_cube(gl, cube);
        gl.BindTextureUnit(3, texture.name());
        const Picture picture = make_picture(gl, GL_RGBA32F, side, side);
        std::string look_up = direction_of_pixel;
        look_up += "void main() { result = vec4(looked_up(direction()), 0); }\n";
        draw_pixels(gl, picture, with_normalise(look_up));
        std::vector<glm::vec3> found(std::size_t{side} * side);
        gl.ReadPixels(0, 0, side, side, GL_RGB, GL_FLOAT, found.data());
        double worst = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const glm::dvec3 v = direction(x, y);
                const glm::dvec3 gpu_found(found[static_cast<std::size_t>(side * y + x)]);
                const glm::dvec3 off = glm::abs(gpu_found - looked_up(cube, v));
                worst = std::max({worst, off.x, off.y, off.z});
            }
        RecordProperty("worst_" + std::to_string(size), std::to_string(worst));
        const double bound = cube_lookup_error(size);
        EXPECT_LE(worst, bound) << size << ": " << 255 * worst << " / 255";
        EXPECT_GT(worst, bound / 64) << size << ": " << 255 * worst << " / 255"; // nor far off
    }
}

struct Errors {
    double low = 0;
    double high = 0;
};

/// The relative errors of the roots of all mantissas of two binades, the least and the greatest.
Errors errors_of_roots(const Gpu& gpu, int steps) {
    constexpr int width = 4096;
    const GlFunctions& gl = gpu.gl();
    const Picture picture = make_picture(gl, GL_R32F, width, width);
    draw_pixels(gl, picture,
                with_normalise("layout(location = 0) out float result;\n"
                               "void main() {\n"
                               "    uvec2 at = uvec2(gl_FragCoord.xy);\n"
                               "    uint bits = 0x3f800000u + 4096u * at.y + at.x;\n"
                               "    result = reciprocal_root(uintBitsToFloat(bits));\n"
                               "}\n",
                               steps));
    std::vector<float> roots(std::size_t{width} * width);
    gl.ReadPixels(0, 0, width, width, GL_RED, GL_FLOAT, roots.data());
    Errors errors{1, -1};
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const auto x = std::bit_cast<float>(0x3f800000U + static_cast<std::uint32_t>(i));
        const double error = roots[i] * std::sqrt(static_cast<double>(x)) - 1;
        errors = {std::min(errors.low, error), std::max(errors.high, error)};
    }
    return errors;
}

TEST(NewtonRaphson, is_within_its_relative_error_for_all_mantissas_of_two_binades) {
    // In exact arithmetic, by the number of steps: after one 0.0017523 (Lomont 2003), and of each
    // share e a further one makes -1.5 e^2 - 0.5 e^3.
    constexpr std::array<Errors, most_newton_steps + 1> bounds{
        Errors{-0.034376, 0.033961}, {-0.0017523, 0}, {-4.6034e-6, 0}, {-3.2e-11, 0}};
    // The square of y, its product with
    // x, the difference and the last product are rounded, which is three units of 2^-24 (see
    // lighting_inputs.cpp), and of an earlier step 0.11 of that is left.
    constexpr double rounded = 3 * 0x1p-24 / (1 - 0.11);
    const Gpu gpu(GlPlatform::osmesa);
    for (int steps = 0; steps <= most_newton_steps; ++steps) {
        const Errors bound = bounds.at(static_cast<std::size_t>(steps));
        const Errors found = errors_of_roots(gpu, steps);
        RecordProperty("least_" + std::to_string(steps), std::to_string(1e6 * found.low));
        EXPECT_GE(found.low, bound.low - rounded) << steps;
        EXPECT_LE(found.high, bound.high + rounded) << steps;
        EXPECT_LT(found.low, 0.99 * bound.low + rounded) << steps; // nor is it far off
    }
}

TEST(Normalise, makes_nothing_of_a_vector_of_length_zero_in_any_way) {
    const Gpu gpu(GlPlatform::osmesa);
    const GlFunctions& gl = gpu.gl();
    const Texture texture = upload_cube(gl, make_normalisation_cube(usual_cube_size));
    gl.BindTextureUnit(3, texture.name());
    const Picture picture = make_picture(gl, GL_RGBA32F, 1, 1);
    for (const char* way : {"unit", "looked_up", "newton"}) {
        std::string call = way == std::string("newton") ? "reciprocal_root(0) * vec3(0)"
                                                        : std::string(way) + "(vec3(0))";
        draw_pixels(gl, picture,
                    with_normalise("layout(location = 0) out vec4 result;\n"
                                   "void main() { result = vec4(" +
                                   call + ", 1); }\n"));
        glm::vec3 found(1);
        gl.ReadPixels(0, 0, 1, 1, GL_RGB, GL_FLOAT, &found);
        EXPECT_EQ(found, glm::vec3(0)) << way;
    }
}

} // namespace
} // namespace shadowproof::tests
