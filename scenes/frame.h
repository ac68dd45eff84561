// What is claimed of one scene: a class for each pixel, perhaps the surface seen there, perhaps
// colours; and the evidence by which a family of techniques came to it.
#pragma once

#include "scenes/counter.h"
#include "scenes/depth_model.h"
#include "scenes/image.h"
#include "scenes/lighting_settings.h"
#include "scenes/pictured.h"
#include "scenes/shadow_map.h"
#include "scenes/traced_rays.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// What a pixel shows; the values are those of the class map, 8-bit gray. Only claims can be partly
/// lit, never the truth; Frame::share then says how much.
enum class Visibility : std::uint8_t { background = 0, shadowed = 64, partly_lit = 160, lit = 255 };
constexpr std::string_view name_of(Visibility visibility) {
    switch (visibility) {
    case Visibility::lit:
        return "lit";
    case Visibility::partly_lit:
        return "partly_lit";
    case Visibility::shadowed:
        return "shadowed";
    case Visibility::background:
        break;
    }
    return "background";
}

/// A part of a frame, and its time.
struct Stage {
    std::string_view name; ///< "volumes", "counting"
    double milliseconds = 0;
};

struct Frame {
    /// The name of its family of claims (compare/families.inc), which decides how it is judged.
    std::string_view family;
    Image<Visibility> claim;
    /// How much of the light is claimed at each pixel, 0 to 1; read where the claim is partly lit.
    /// Empty where the claim is all or nothing.
    Image<double> share{};
    /// The surface that is shown at each pixel; empty where the claim shows none.
    Image<std::uint32_t> triangle; ///< index into Scene::triangles, or no_triangle
    Image<float> depth;            ///< window depth in [0, 1]
    DepthFormat depth_format{};    ///< of the buffer, as the driver names it
    DepthModel depth_model;        ///< by which the depths were made
    /// Claimed colours where the technique lights bump maps, else empty: linear, as blending left
    /// them: floats neither clamped nor rounded, or k / 255 where the buffer holds bytes.
    /// Background is black.
    Image<glm::vec3> color{};
    ColorModel color_model{}; ///< how they were made
    /// What is claimed under the lights before the chosen one, in their order, where the colours
    /// add them up (added_lights in scene.h).
    std::vector<Image<Visibility>> claims_before{};
    // The evidence, one member per family that has any:
    std::optional<CounterEvidence> counted;  ///< shadow volumes: the counter read back
    std::optional<PicturedShadows> pictured; ///< pictures: how bright they are
    std::optional<MapEvidence> mapped;       ///< shadow maps: the texels read back
    std::optional<TracedRays> rays;          ///< traced shadows: the rays as they were shot
    double milliseconds = 0; ///< making the evidence, drawing and finishing, without the read-back
    std::vector<Stage> stages{};       ///< of one more frame, which waited for each; may be empty
    std::vector<std::string> left_out; ///< what the technique omitted because the scene does not
                                       ///< need it, one clause each

    bool shows_surface() const { return !triangle.pixels.empty(); }
};

/// How much of the light the claim shows at a pixel, given by its index: 0 to 1. A frame with a
/// pixel that is partly lit must have shares.
inline double lit_share(const Frame& frame, std::size_t pixel) {
    if (frame.claim.pixels[pixel] == Visibility::partly_lit) return frame.share.pixels[pixel];
    return frame.claim.pixels[pixel] == Visibility::lit ? 1 : 0;
}

/// The driver that drew a frame, as it identifies itself.
struct DriverInfo {
    std::string version;
    std::string renderer;
    int subpixel_bits = 0;
    int depth_bits = 0;
    int stencil_bits = 0;
};

} // namespace shadowproof
