// Stencil shadow volumes: the passes of W (surface, volume, light) as a recipe says.
#pragma once

#include "raster/context.h"
#include "raster/lighting.h"
#include "raster/volume_pass.h"
#include "scenes/frame.h"
#include "scenes/plan.h"
#include "scenes/scene.h"

#include <optional>

namespace shadowproof {

/// How a technique that counts in front of the surface makes up for what the near plane clips.
enum class NearPlane : std::uint8_t {
    lost,       ///< not at all
    capped,     ///< volumes are closed on the near plane; needs a finite projection
    from_light, ///< the occluders between light and near plane are drawn from the light
};

/// All that tells one stencil technique from another.
struct StencilRecipe {
    Counting counting;      ///< near_plane's effect on `start` included
    DepthModel depth_model; ///< subpixel_bits is taken from the driver
    VolumeMaking making = VolumeMaking::on_cpu;
    std::function<Extruder(const Scene& casters)> extruder = by_silhouettes; ///< on the CPU
    /// A flag a triangle of the scene: where faces in front of the surface are counted, its light
    /// cap is not drawn, as it is never in front of what is seen. On the CPU only; empty: all are.
    std::vector<std::uint8_t> hidden_caps{};
    NearPlane near_plane = NearPlane::lost;
    Counter counter = Counter::stencil; ///< a sum asks for Counting::bits 24 and wrapping
    /// Colours beside the claim: of bump-lit scenes, with a stencil, and relative to the eye.
    std::optional<LightingRecipe> lighting{};
};

/// Draws one pixel of the frame, so that the driver compiles what it has put off, and then the
/// whole up to three times, of which the quickest is timed, with the making of what depends on the
/// light. Reads back the pictures, and draws the volumes once more to show and to measure them.
/// Throws Error where the driver fails.
Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const StencilRecipe& recipe);

/// The recipes that the techniques begin with.
StencilRecipe zpass_recipe(const Scene& scene);
StencilRecipe zfail_reversed_recipe(const Scene& scene, const Plan& plan);

} // namespace shadowproof
