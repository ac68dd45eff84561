#include "raster/gl/context.h"
#include "raster/gl/shader.h"
#include "scenes/error.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace shadowproof::tests {
namespace {

constexpr std::string_view vertex = "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n";

std::string message_of(const GlFunctions& gl, const ShaderText& first, const ShaderText& second) {
    try {
        link(gl, std::array{first, second});
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Shader, one_that_does_not_compile_is_named_with_file_and_line) {
    const Gpu gpu(GlPlatform::osmesa);
    const std::string message =
        message_of(gpu.gl(), {"good.vert", vertex},
                   {"broken.frag", "#version 450 core\nvoid main() {\n    nothing = 1;\n}\n"});
    EXPECT_NE(message.find("broken.frag:3("), std::string::npos) << message;
    EXPECT_NE(message.find("nothing"), std::string::npos) << message;
}

TEST(Shader, two_that_do_not_fit_are_named_both) {
    const Gpu gpu(GlPlatform::osmesa);
    const std::string message = message_of(
        gpu.gl(), {"good.vert", vertex},
        {"asks.frag", "#version 450 core\nin vec3 missing;\nout vec3 color;\nvoid main() { color = "
                      "missing; }\n"});
    EXPECT_NE(message.find("good.vert and asks.frag: do not link"), std::string::npos) << message;
    EXPECT_NE(message.find("missing"), std::string::npos) << message;
}

TEST(Shader, every_pass_is_embedded_and_an_unknown_file_is_empty) {
    for (const char* file : {"project.vert", "surface.frag", "volume.frag", "light.frag"})
        EXPECT_TRUE(glsl_source(file).starts_with("#version 450 core\n")) << file;
    EXPECT_TRUE(glsl_source("no such.frag").empty());
}

} // namespace
} // namespace shadowproof::tests
