#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_infinite with more precise depths: n/t in floating point, so that distant depths are near
/// zero, where floats are dense; and vertices made relative to the eye before the matrix rounds
/// them.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    return made;
}

} // namespace

Technique zfail_reversed_technique() {
    return {.name = "zfail_reversed",
            .summary = "zfail_infinite with reversed floating depth and eye-relative vertices",
            .source = "Everitt & Kilgard 2002, with the depth range reversed",
            .needs = "closed volumes, glClipControl and a D32F depth buffer",
            .cost = 1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
