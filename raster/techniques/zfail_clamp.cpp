#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Counts volume faces behind the visible surface; depth clamping keeps faces past the far plane,
/// so the whole volume is counted. Where no volume reaches that plane, nothing is clamped.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    DepthModel depth_model = finite_depths(scene);
    depth_model.clamp = plan.volume_meets_far;
    return zfail_recipe(plan, depth_model);
}

} // namespace

Technique zfail_clamp_technique() {
    return {.name = "zfail_clamp",
            .summary = "counts volume faces behind the surface, depths clamped to near and far",
            .source = "Everitt & Kilgard 2002; omni-directional shadows with geometry shaders",
            .needs = "closed volumes, and GL_DEPTH_CLAMP",
            .cost = 1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
