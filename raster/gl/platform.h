// The source of a GL context: all that context.cpp needs of OSMesa or EGL.
#pragma once

#include <memory>

namespace shadowproof {

using GlProcedure = void (*)();

/// Owns a context of OpenGL 4.5 core.
struct Platform {
    Platform() = default;
    virtual ~Platform() = default;
    Platform(const Platform&) = delete;
    Platform& operator=(const Platform&) = delete;

    virtual void make_current() = 0;                ///< on the calling thread; throws Error
    virtual GlProcedure find(const char* name) = 0; ///< may not be null for an absent function
};

/// Both throw Error where the library is missing or offers no such context.
std::unique_ptr<Platform> make_osmesa_platform();
std::unique_ptr<Platform> make_egl_platform();

} // namespace shadowproof
