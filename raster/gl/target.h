// Render targets, and reading them back.
#pragma once

#include "raster/gl/gl.h"
#include "scenes/camera.h"
#include "scenes/frame.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The pictures that the passes draw, of the camera's size. Only some techniques need those from
/// `sum` on.
struct Target {
    int width = 0;
    int height = 0;
    Texture claim;               ///< R8: values of Visibility
    Texture triangle;            ///< R32UI
    Texture depth_stencil;       ///< D24 or D32F, and 8 bits
    Framebuffer surface;         ///< all three
    Framebuffer light;           ///< without `triangle`, which the light pass reads
    Texture sum{};               ///< R32F: sum of the faces' worth (volume.frag); made by add_sum
    Framebuffer adding{};        ///< `sum` and `depth_stencil`
    Texture color{};             ///< the light leaving each surface; made by add_color
    Framebuffer lighting{};      ///< `color` and `depth_stencil`
    bool color_in_bytes = false; ///< RGBA8, linear; otherwise RGBA32F
};
Texture make_claim(const GlFunctions& gl, int width, int height);
Target make_target(const GlFunctions& gl, const Camera& camera, bool floating);
void add_sum(const GlFunctions& gl, Target& target);
void add_color(const GlFunctions& gl, Target& target, bool in_bytes);

/// Begins a pass that sums the worth (volume.frag) of its faces in `sum`, from `start`.
void begin_adding(const GlFunctions& gl, const Target& target, float start = 0);
void end_adding(const GlFunctions& gl);

/// Where faces are counted, and from where the light pass reads shadows.
enum class Counter : std::uint8_t {
    stencil,
    sum,  ///< in a colour, by blending; exact to 24 bits
    none, ///< faces are not counted: the light pass finds shadows by a shader of its own
};

/// The format that the driver reports, whatever was requested.
DepthFormat depth_format(const GlFunctions& gl, const Texture& texture);

/// The pictures, rows from the top, and what was counted. Counting, depth model and other evidence
/// are left to the caller.
Frame read_back(const GlFunctions& gl, const Target& target, Counter counter);

/// What the claim holds, rows from the top.
Image<Visibility> read_claim(const GlFunctions& gl, const Target& target);

/// The sums, rows from the top.
Image<float> read_sum(const GlFunctions& gl, const Target& target);

/// The colours, rows from the top; from bytes k / 255, rounded to float.
Image<glm::vec3> read_color(const GlFunctions& gl, const Target& target);

} // namespace shadowproof
