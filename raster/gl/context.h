// An OpenGL 4.5 core context without a window: OSMesa, or surfaceless EGL.
#pragma once

#include "scenes/byte_blending.h"
#include "scenes/frame.h"

#include <memory>
#include <string>
#include <string_view>

namespace shadowproof {

enum class GlPlatform : std::uint8_t { osmesa, egl };

struct GlFunctions; // gl.h
struct Platform;    // platform.h

/// Owns the context. Passed to everything that draws, so there is no hidden current context. Each
/// object that holds a GL name keeps a reference to its Gpu's functions, and must not outlive the
/// Gpu.
class Gpu {
public:
    /// The context is current on this thread afterwards. Throws Error: no library, no context,
    /// wrong renderer.
    explicit Gpu(GlPlatform platform);
    ~Gpu();
    Gpu(Gpu&&) noexcept;
    Gpu& operator=(Gpu&&) noexcept;
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    /// Must be called before drawing: another Gpu may have become current, or another thread may
    /// call.
    void make_current();

    /// Whether frames measure the time of each stage (Frame::stages). By default they do not.
    bool tells_stages() const { return tells_stages_; }
    void tell_stages(bool tell) { tells_stages_ = tell; }

    /// The most frames that are timed, as many as begin within 20 ms: the quickest is the time. One
    /// by default.
    int timed_frames() const { return timed_frames_; }
    void time_frames(int most) { timed_frames_ = most; }

    const GlFunctions& gl() const;
    const DriverInfo& driver() const; ///< depth and stencil bits are those of a D24_S8 texture

    /// Whether an extension's name is listed. Function pointers prove nothing: Mesa returns some
    /// for extensions that it does not have.
    bool has_extension(std::string_view name) const;

    /// How far off the bytes are that it writes into colour buffers.
    ByteErrors byte_errors() const;

private:
    struct Context;
    std::unique_ptr<Context> context_;
    bool tells_stages_ = false;
    int timed_frames_ = 1;
};

} // namespace shadowproof
