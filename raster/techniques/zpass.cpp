#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Counts volume faces in front of the visible surface: s(surface) - s(near plane), which is wrong
/// where the near plane lies inside a volume. The dark cap is never in front of anything; the light
/// cap only where its own surface is culled, being seen from behind.
StencilRecipe recipe(const Scene& scene, const Plan& /*plan*/) {
    return zpass_recipe(scene);
}

} // namespace

Technique zpass_technique() {
    return {.name = "zpass",
            .summary = "counts volume faces in front of the surface",
            .source = "Heidmann 1991; Kilgard 2001, stencilled shadow volumes; VGP353 week 5",
            .needs = "a near plane outside every shadow volume",
            .cost = 1.05,
            .fails_at = {Cause::near_plane, Cause::eye_inside, Cause::precision, Cause::counter,
                         Cause::open_mesh, Cause::alpha, Cause::light_inside},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
