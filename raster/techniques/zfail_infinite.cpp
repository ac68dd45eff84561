#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Counts volume faces behind the visible surface; the far plane is at infinity, where the dark cap
/// is just not clipped.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    return zfail_recipe(plan, infinite_depths(scene));
}

} // namespace

Technique zfail_infinite_technique() {
    return {.name = "zfail_infinite",
            .summary = "counts volume faces behind the surface, under an infinite projection",
            .source = "Everitt & Kilgard 2002; omni-directional shadows with geometry shaders",
            .needs = "closed volumes, and a perspective camera",
            .cost = 0.99,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = infinite_depths,
            .recipe = recipe};
}

} // namespace shadowproof
