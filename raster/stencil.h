// Stencil shadow volumes: the passes of W (surface, volume, light) as a recipe says.
#pragma once

#include "raster/context.h"
#include "raster/volume_pass.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

namespace shadowproof {

/// What a face of the volume adds to the counter where its depth test comes out as counted: +1, -1
/// or 0.
struct StencilSteps {
    int front = 0;
    int back = 0;
};

/// How a technique that counts in front of the surface makes up for what the near plane clips.
enum class NearPlane : std::uint8_t {
    lost,       ///< not at all
    capped,     ///< volumes are closed on the near plane; needs a finite projection
    from_light, ///< the occluders between light and near plane are drawn from the light
};

/// All that tells one stencil technique from another.
struct StencilRecipe {
    Counting counting; ///< near_plane's effect on `start` included
    StencilSteps steps;
    DepthModel depth_model; ///< subpixel_bits is taken from the driver
    VolumeMaking making = VolumeMaking::on_cpu;
    std::function<Extruder(const Scene& casters)> extruder = by_silhouettes; ///< on the CPU
    NearPlane near_plane = NearPlane::lost;
};

/// Draws the frame twice, for the first time compiles what the driver has put off, and reads back
/// and times the second, with the making of what depends on the light. Throws Error for a
/// directional light, and where the driver fails.
Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const StencilRecipe& recipe);

/// The recipes that the techniques begin with.
StencilRecipe zpass_recipe(const Scene& scene);
StencilRecipe zfail_reversed_recipe(const Scene& scene);

} // namespace shadowproof
