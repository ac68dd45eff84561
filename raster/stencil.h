// Stencil shadow volumes: the passes of W (surface, volume, light) as a recipe says.
#pragma once

#include "raster/context.h"
#include "raster/volume.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

namespace shadowproof {

/// What a face of the volume adds to the counter where its depth test comes out as counted: +1, -1
/// (both wrapping) or 0.
struct StencilSteps {
    int front = 0;
    int back = 0;
};

/// All that tells one stencil technique from another.
struct StencilRecipe {
    Counting counting; ///< caps: those of the volume that are drawn, if it has them
    StencilSteps steps;
    DepthModel depth_model; ///< subpixel_bits is taken from the driver
};

/// Draws the frame twice, for the first time compiles what the driver has put off, and reads back
/// and times the second. Throws Error for a directional light, and where the driver fails.
Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const ShadowVolume& volume,
                           const StencilRecipe& recipe);

} // namespace shadowproof
