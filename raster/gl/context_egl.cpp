#include "raster/gl/platform.h"
#include "scenes/error.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace shadowproof {

namespace {

struct CloseLibrary {
    void operator()(void* library) const { dlclose(library); }
};

/// Loaded only when used, so that nothing else needs EGL.
struct Egl final : Platform {
    std::unique_ptr<void, CloseLibrary> library;
    PFNEGLGETPROCADDRESSPROC get_proc_address = nullptr;
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    Egl() : library(dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL)) {
        if (!library)
            throw Error("EGL", "libEGL.so.1 cannot be opened", "install libegl1 and libegl-mesa0");
        get_proc_address =
            reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(dlsym(library.get(), "eglGetProcAddress"));
        if (!get_proc_address) fail("libEGL.so.1 has no eglGetProcAddress");
        open_display();
        create_context();
    }
    ~Egl() override {
        call<PFNEGLMAKECURRENTPROC>("eglMakeCurrent")(display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                                                      EGL_NO_CONTEXT);
        call<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")(display, context);
    }

    void make_current() override {
        call<PFNEGLBINDAPIPROC>("eglBindAPI")(EGL_OPENGL_API);
        if (!call<PFNEGLMAKECURRENTPROC>("eglMakeCurrent")(display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                                                           context))
            fail("the context cannot be made current without a surface");
    }
    GlProcedure find(const char* name) override { return get_proc_address(name); }

private:
    [[noreturn]] static void fail(const std::string& what) {
        throw Error("EGL", what, "use --gl osmesa, or a driver with surfaceless contexts");
    }
    template <class Function>
    Function call(const char* name) const {
        const auto function = reinterpret_cast<Function>(get_proc_address(name));
        if (!function) fail(std::string("has no ") + name);
        return function;
    }

    /// The display is shared by all its users, so it is never terminated. Mesa has one without a
    /// surface; a driver that has none of those is asked for its devices.
    void open_display() {
        const char* const listed =
            call<PFNEGLQUERYSTRINGPROC>("eglQueryString")(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        const std::string_view extensions = listed ? listed : "";
        const auto has = [&](const char* name) {
            return extensions.find(name) != std::string_view::npos;
        };
        if (has("EGL_MESA_platform_surfaceless") &&
            opens(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY))
            return;
        if (has("EGL_EXT_platform_device") && open_device()) return;
        fail("no display can be opened, neither without a surface nor of a device");
    }

    bool opens(EGLenum platform, void* native) {
        display =
            call<PFNEGLGETPLATFORMDISPLAYPROC>("eglGetPlatformDisplay")(platform, native, nullptr);
        return display != EGL_NO_DISPLAY &&
               call<PFNEGLINITIALIZEPROC>("eglInitialize")(display, nullptr, nullptr);
    }

    /// The first one that can be used (EGL_EXT_device_enumeration).
    bool open_device() {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (!call<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT")(
                static_cast<EGLint>(devices.size()), devices.data(), &count))
            return false;
        const std::span found = std::span(devices).first(static_cast<std::size_t>(count));
        return std::ranges::any_of(
            found, [&](EGLDeviceEXT device) { return opens(EGL_PLATFORM_DEVICE_EXT, device); });
    }

    void create_context() {
        constexpr std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                               EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        call<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig")(display, wanted.data(), &config, 1, &count);
        constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                                   4,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   5,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_NONE};
        call<PFNEGLBINDAPIPROC>("eglBindAPI")(EGL_OPENGL_API);
        context = call<PFNEGLCREATECONTEXTPROC>("eglCreateContext")(
            display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, attributes.data());
        if (context == EGL_NO_CONTEXT) fail("offers no OpenGL 4.5 core context");
    }
};

} // namespace

std::unique_ptr<Platform> make_egl_platform() {
    return std::make_unique<Egl>();
}

} // namespace shadowproof
