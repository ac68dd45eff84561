#include "raster/gl/context.h"

#include "raster/gl/gl.h"
#include "raster/gl/platform.h"
#include "scenes/error.h"

#include <algorithm>
#include <vector>

namespace shadowproof {

struct Gpu::Context {
    std::unique_ptr<Platform> platform;
    GlFunctions gl;
    DriverInfo driver;
    std::vector<std::string> extensions;
};

namespace {

std::string text(const GlFunctions& gl, GLenum name) {
    const GLubyte* const value = gl.GetString(name);
    return value ? reinterpret_cast<const char*>(value) : "";
}

int integer(const GlFunctions& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

std::vector<std::string> list_extensions(const GlFunctions& gl) {
    std::vector<std::string> names(static_cast<std::size_t>(integer(gl, GL_NUM_EXTENSIONS)));
    for (std::size_t i = 0; i < names.size(); ++i)
        names[i] =
            reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    return names;
}

DriverInfo ask_driver(const GlFunctions& gl) {
    DriverInfo info{.version = text(gl, GL_VERSION),
                    .renderer = text(gl, GL_RENDERER),
                    .subpixel_bits = integer(gl, GL_SUBPIXEL_BITS)};
    const Texture texture = make_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.name(), 1, GL_DEPTH24_STENCIL8, 1, 1);
    gl.GetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_DEPTH_SIZE, &info.depth_bits);
    gl.GetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_STENCIL_SIZE, &info.stencil_bits);
    check(gl, "the questions to the driver");
    return info;
}

bool draws_with(const DriverInfo& driver, std::string_view name) {
    return driver.renderer.find(name) != std::string::npos;
}

/// Softpipe snaps vertices to 1/16 of a pixel: its error band would hide real defects. OSMesa is
/// used because its llvmpipe draws the same pixels everywhere, so there it must be llvmpipe.
void refuse_others(const DriverInfo& driver, GlPlatform platform) {
    if (draws_with(driver, "softpipe") ||
        (platform == GlPlatform::osmesa && !draws_with(driver, "llvmpipe")))
        throw Error("OpenGL", "the renderer is '" + driver.renderer + "', not llvmpipe",
                    "unset GALLIUM_DRIVER and install a Mesa with LLVM");
}

} // namespace

Gpu::Gpu(GlPlatform platform) : context_(std::make_unique<Context>()) {
    context_->platform =
        platform == GlPlatform::osmesa ? make_osmesa_platform() : make_egl_platform();
    context_->platform->make_current();
    context_->gl = load_gl(*context_->platform);
    context_->extensions = list_extensions(context_->gl);
    context_->driver = ask_driver(context_->gl);
    refuse_others(context_->driver, platform);
}

Gpu::~Gpu() = default;
Gpu::Gpu(Gpu&&) noexcept = default;
Gpu& Gpu::operator=(Gpu&&) noexcept = default;

void Gpu::make_current() {
    context_->platform->make_current();
}

const GlFunctions& Gpu::gl() const {
    return context_->gl;
}

const DriverInfo& Gpu::driver() const {
    return context_->driver;
}

ByteErrors Gpu::byte_errors() const {
    return draws_with(driver(), "llvmpipe") ? llvmpipe_bytes : hardware_bytes;
}

bool Gpu::has_extension(std::string_view name) const {
    return std::ranges::find(context_->extensions, name) != context_->extensions.end();
}

} // namespace shadowproof
