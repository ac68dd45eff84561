// What byte_blending.h says of the driver: all pairs of bytes, and floats between them.
#include "raster/gl/context.h"
#include "scenes/byte_blending.h"
#include "tests/raster/drawn_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof::tests {
namespace {

constexpr const char* overwrite_by_column =
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = vec4((gl_FragCoord.x - 0.5) / 255); }\n";
constexpr const char* blend_by_row =
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = vec4((gl_FragCoord.y - 0.5) / 255); }\n";

class ByteBlending : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};
    const GlFunctions& gl = gpu.gl();

    /// The red of each pixel, rows from the bottom.
    std::vector<std::uint8_t> red(const Picture& picture) const {
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(picture.width) *
                                        static_cast<std::size_t>(picture.height));
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl.ReadPixels(0, 0, picture.width, picture.height, GL_RED, GL_UNSIGNED_BYTE, bytes.data());
        return bytes;
    }

    /// Column x of the picture holds the byte x, onto which row y blends the byte y.
    std::vector<std::uint8_t> blended(GLenum source, GLenum destination) const {
        const Picture picture = make_picture(gl, GL_RGBA8, 256, 256);
        gl.Disable(GL_DITHER);
        draw_pixels(gl, picture, overwrite_by_column);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(source, destination);
        draw_pixels(gl, picture, blend_by_row);
        gl.Disable(GL_BLEND);
        return red(picture);
    }

    /// The largest error in steps, of all pairs.
    template <class Exact>
    static double worst(const std::vector<std::uint8_t>& bytes, const Exact& exact) {
        double worst = 0;
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x)
                worst = std::max(
                    worst, std::abs(bytes[static_cast<std::size_t>(256 * y + x)] - exact(x, y)));
        return worst;
    }
};

TEST_F(ByteBlending, multiplies_all_pairs_of_bytes_within_its_error) {
    const double off =
        worst(blended(GL_DST_COLOR, GL_ZERO), [](int x, int y) { return x * y / 255.0; });
    RecordProperty("steps", std::to_string(off));
    EXPECT_LE(off, llvmpipe_bytes.multiplying);
    EXPECT_GT(off, 0.49); // it is no exact product
}

TEST_F(ByteBlending, adds_all_pairs_of_bytes_within_its_error) {
    const double off =
        worst(blended(GL_ONE, GL_ONE), [](int x, int y) { return std::min<double>(x + y, 255); });
    RecordProperty("steps", std::to_string(off));
    EXPECT_LE(off, llvmpipe_bytes.adding);
}

TEST_F(ByteBlending, rounds_floats_to_the_nearest_byte_and_clamps_them) {
    constexpr int parts = 4096; // of a step
    const Picture picture = make_picture(gl, GL_RGBA8, 2 * parts, 258);
    gl.Disable(GL_DITHER);
    draw_pixels(gl, picture,
                "layout(location = 0) out vec4 color;\n"
                "void main() {\n"
                "    vec2 at = gl_FragCoord.xy - 0.5;\n"
                "    color = vec4((at.y - 1 + at.x / 8192) / 255);\n"
                "}\n");
    const std::vector<std::uint8_t> bytes = red(picture);
    double worst = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const double exact = std::clamp(y - 1 + x / 8192.0, 0.0, 255.0);
            const std::size_t i =
                static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(y) +
                static_cast<std::size_t>(x);
            worst = std::max(worst, std::abs(bytes[i] - exact));
        }
    RecordProperty("steps", std::to_string(worst));
    EXPECT_LE(worst, llvmpipe_bytes.overwriting);
}

TEST_F(ByteBlending, rounds_a_float_to_a_byte_before_it_is_blended) {
    const Picture picture = make_picture(gl, GL_RGBA8, 256, 1);
    gl.Disable(GL_DITHER);
    draw_pixels(gl, picture, overwrite_by_column);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    draw_pixels(gl, picture,
                "layout(location = 0) out vec4 color;\n"
                "void main() { color = vec4(0.4 / 255); }\n");
    gl.Disable(GL_BLEND);
    const std::vector<std::uint8_t> bytes = red(picture);
    for (std::size_t x = 0; x < bytes.size(); ++x) EXPECT_EQ(bytes[x], x);
}

} // namespace
} // namespace shadowproof::tests
