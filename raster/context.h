// An OpenGL 4.5 core context without a window: OSMesa, or surfaceless EGL.
#pragma once

#include "scenes/frame.h"

#include <memory>
#include <string>

namespace shadowproof {

enum class GlPlatform : std::uint8_t { osmesa, egl };

struct GlFunctions; // gl.h

/// Owns the context. Passed to everything that draws; there is no hidden current one: each object
/// that holds a GL name keeps a reference to its Gpu.
class Gpu {
public:
    explicit Gpu(GlPlatform platform); ///< throws Error: no library, no context, wrong renderer
    ~Gpu();
    Gpu(Gpu&&) noexcept;
    Gpu& operator=(Gpu&&) noexcept;
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    const GlFunctions& gl() const;
    const DriverInfo& driver() const;

private:
    struct Context;
    std::unique_ptr<Context> context_;
};

} // namespace shadowproof
