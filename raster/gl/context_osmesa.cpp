#include "raster/gl/platform.h"
#include "scenes/error.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>

namespace shadowproof {

namespace {

struct Osmesa final : Platform {
    OSMesaContext context = nullptr;
    std::array<std::uint32_t, 16> pixels{}; // 4x4 RGBA: techniques draw into textures of their own

    Osmesa() {
        constexpr std::array attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_DEPTH_BITS,
                                        24,
                                        OSMESA_STENCIL_BITS,
                                        8,
                                        OSMESA_ACCUM_BITS,
                                        0,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        4,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        5,
                                        0};
        context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (!context)
            throw Error("OSMesa", "offers no OpenGL 4.5 core context",
                        "install libosmesa6 of Mesa 20 or later");
    }
    ~Osmesa() override { OSMesaDestroyContext(context); }

    void make_current() override {
        if (!OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, 4, 4))
            throw Error("OSMesa", "the context cannot be made current",
                        "check that no other library brought its own OpenGL");
    }
    GlProcedure find(const char* name) override { return OSMesaGetProcAddress(name); }
};

} // namespace

std::unique_ptr<Platform> make_osmesa_platform() {
    return std::make_unique<Osmesa>();
}

} // namespace shadowproof

#ifdef __SANITIZE_ADDRESS__
/// OSMesa keeps its framebuffers in a list that it never frees. The suppression is here so that
/// every program that links OSMesa and is built with the sanitizer reports only its own leaks.
extern "C" const char* __lsan_default_suppressions(); // NOLINT: the sanitizer's name
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOSMesa\n";
}
/// Prints nothing about suppressed leaks: what the program prints is tested.
extern "C" const char* __lsan_default_options(); // NOLINT: the sanitizer's name
extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}
#endif
