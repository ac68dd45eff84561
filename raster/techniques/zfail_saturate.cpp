#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed with a counter that stops at 0 and 255 instead of wrapping: a decrement at 0,
/// before its increment, is lost.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.counting.operation = Counting::Operation::saturate;
    made.counting.caps_first = scene.camera.is_orthographic();
    return made;
}

} // namespace

Technique zfail_saturate_technique() {
    return {.name = "zfail_saturate",
            .summary = "zfail_reversed with a counter that saturates",
            .source = "Kilgard 2001, before EXT_stencil_wrap",
            .needs = "faces in an order that never counts below zero",
            .cost = 0.85,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .by_nature = {Cause::counter},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
