#include "raster/gl/target.h"

#include "scenes/error.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_precision.hpp>
#include <string>
#include <vector>

namespace shadowproof {

namespace {

Texture make_picture(const GlFunctions& gl, GLenum format, int width, int height) {
    Texture texture = make_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.name(), 1, format, width, height);
    // With integer texels the initial, linear filter makes a texture incomplete, and its texels
    // zero.
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void require_complete(const GlFunctions& gl, const Framebuffer& framebuffer) {
    if (gl.CheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE)
        throw Error(
            "OpenGL",
            "the driver cannot draw into R8, RGBA8, R32UI, float and depth-stencil textures",
            "use --gl osmesa");
}

/// A framebuffer of one picture beside the target's depth and stencil.
Framebuffer beside_depth(const GlFunctions& gl, const Target& target, const Texture& picture) {
    Framebuffer framebuffer = make_framebuffer(gl);
    gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, picture.name(), 0);
    gl.NamedFramebufferTexture(framebuffer.name(), GL_DEPTH_STENCIL_ATTACHMENT,
                               target.depth_stencil.name(), 0);
    require_complete(gl, framebuffer);
    return framebuffer;
}

/// OpenGL's rows run from the bottom.
template <class Value>
Image<Value> from_bottom_up(int width, int height, const std::vector<Value>& rows) {
    Image<Value> image(width, height);
    const auto stride = static_cast<std::ptrdiff_t>(width);
    for (std::ptrdiff_t y = 0; y < height; ++y)
        std::copy_n(rows.begin() + (height - 1 - y) * stride, stride,
                    image.pixels.begin() + y * stride);
    return image;
}

template <class Value>
Image<Value> read_picture(const GlFunctions& gl, const Target& target, GLenum format, GLenum type) {
    std::vector<Value> rows(static_cast<std::size_t>(target.width) *
                            static_cast<std::size_t>(target.height));
    gl.ReadPixels(0, 0, target.width, target.height, format, type, rows.data());
    return from_bottom_up(target.width, target.height, rows);
}

template <class Value>
Image<Value> read_framebuffer(const GlFunctions& gl, const Target& target,
                              const Framebuffer& framebuffer, GLenum format,
                              GLenum type = GL_FLOAT) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.NamedFramebufferReadBuffer(framebuffer.name(), GL_COLOR_ATTACHMENT0);
    Image<Value> image = read_picture<Value>(gl, target, format, type);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return image;
}

} // namespace

Texture make_claim(const GlFunctions& gl, int width, int height) {
    return make_picture(gl, GL_R8, width, height);
}

Target make_target(const GlFunctions& gl, const Camera& camera, bool floating) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (camera.width > most || camera.height > most)
        throw Error("size " + std::to_string(camera.width) + "x" + std::to_string(camera.height),
                    "the driver draws at most " + std::to_string(most) + " pixels a side",
                    "ask for a smaller picture");

    const auto picture = [&](GLenum format) {
        return make_picture(gl, format, camera.width, camera.height);
    };
    Target target{.width = camera.width,
                  .height = camera.height,
                  .claim = make_claim(gl, camera.width, camera.height),
                  .triangle = picture(GL_R32UI),
                  .depth_stencil = picture(floating ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8),
                  .surface = make_framebuffer(gl),
                  .light = make_framebuffer(gl)};
    for (const GLuint framebuffer : {target.surface.name(), target.light.name()}) {
        gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target.claim.name(), 0);
        gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT,
                                   target.depth_stencil.name(), 0);
    }
    gl.NamedFramebufferTexture(target.surface.name(), GL_COLOR_ATTACHMENT1, target.triangle.name(),
                               0);
    constexpr std::array<GLenum, 2> both{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    gl.NamedFramebufferDrawBuffers(target.surface.name(), 2, both.data());
    require_complete(gl, target.surface);
    require_complete(gl, target.light);
    check(gl, "making the pictures");
    return target;
}

void add_sum(const GlFunctions& gl, Target& target) {
    target.sum = make_picture(gl, GL_R32F, target.width, target.height);
    target.adding = beside_depth(gl, target, target.sum);
}

void add_color(const GlFunctions& gl, Target& target, bool in_bytes) {
    target.color_in_bytes = in_bytes;
    target.color = make_picture(gl, in_bytes ? GL_RGBA8 : GL_RGBA32F, target.width, target.height);
    target.lighting = beside_depth(gl, target, target.color);
}

void begin_adding(const GlFunctions& gl, const Target& target, float start) {
    const std::array<GLfloat, 4> all{start, start, start, start};
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.ClearNamedFramebufferfv(target.adding.name(), GL_COLOR, 0, all.data());
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.adding.name());
    gl.DepthMask(GL_FALSE);
    gl.Disable(GL_STENCIL_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
}

void end_adding(const GlFunctions& gl) {
    gl.Disable(GL_BLEND);
}

DepthFormat depth_format(const GlFunctions& gl, const Texture& texture) {
    DepthFormat format;
    GLint type = 0;
    gl.GetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_DEPTH_SIZE, &format.bits);
    gl.GetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_DEPTH_TYPE, &type);
    format.floating = type == GL_FLOAT;
    return format;
}

Frame read_back(const GlFunctions& gl, const Target& target, Counter counter) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.surface.name());
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    Frame frame;
    gl.NamedFramebufferReadBuffer(target.surface.name(), GL_COLOR_ATTACHMENT0);
    frame.claim = read_picture<Visibility>(gl, target, GL_RED, GL_UNSIGNED_BYTE);
    gl.NamedFramebufferReadBuffer(target.surface.name(), GL_COLOR_ATTACHMENT1);
    frame.triangle = read_picture<std::uint32_t>(gl, target, GL_RED_INTEGER, GL_UNSIGNED_INT);
    frame.depth = read_picture<float>(gl, target, GL_DEPTH_COMPONENT, GL_FLOAT);
    frame.depth_format = depth_format(gl, target.depth_stencil);
    if (counter == Counter::stencil)
        frame.counted.emplace().counter =
            read_picture<std::uint32_t>(gl, target, GL_STENCIL_INDEX, GL_UNSIGNED_INT);
    if (counter == Counter::sum)
        frame.counted.emplace().counter =
            converted<std::uint32_t>(read_sum(gl, target), [](float sum) {
                return static_cast<std::uint32_t>(static_cast<std::int32_t>(sum)) & 0xffffffU;
            });
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    check(gl, "reading back");
    return frame;
}

Image<Visibility> read_claim(const GlFunctions& gl, const Target& target) {
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    return read_framebuffer<Visibility>(gl, target, target.light, GL_RED, GL_UNSIGNED_BYTE);
}

Image<float> read_sum(const GlFunctions& gl, const Target& target) {
    return read_framebuffer<float>(gl, target, target.adding, GL_RED);
}

Image<glm::vec3> read_color(const GlFunctions& gl, const Target& target) {
    if (!target.color_in_bytes)
        return read_framebuffer<glm::vec3>(gl, target, target.lighting, GL_RGB);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    const auto bytes =
        read_framebuffer<glm::u8vec3>(gl, target, target.lighting, GL_RGB, GL_UNSIGNED_BYTE);
    return converted<glm::vec3>(
        bytes, [](const glm::u8vec3& color) { return glm::vec3(glm::dvec3(color) / 255.0); });
}

} // namespace shadowproof
