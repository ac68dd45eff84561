#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_infinite with more precise depths: n/t in floating point, so that distant depths are near
/// zero, where floats are dense; and vertices made relative to the eye before the matrix rounds
/// them.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    StencilRecipe recipe = zfail_reversed_recipe(scene, plan);
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique zfail_reversed_technique() {
    return {.name = "zfail_reversed",
            .summary = "zfail_infinite with reversed floating depth and eye-relative vertices",
            .source = "Everitt & Kilgard 2002, with the depth range reversed",
            .needs = "closed volumes, glClipControl and a D32F depth buffer",
            .cost = 1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .depth_model = reversed_depths,
            .run = run};
}

} // namespace shadowproof
