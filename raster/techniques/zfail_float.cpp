#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed with a counter that no scene overflows: faces are summed in a colour of 32-bit
/// floating point, which holds all integers of 24 bits. Blending applies to what passes the depth
/// test, so the test passes what lies behind the surface.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.counter = Counter::sum;
    made.counting.bits = 24;
    return made;
}

} // namespace

Technique zfail_float_technique() {
    return {.name = "zfail_float",
            .summary = "zfail_reversed that adds up faces in a floating-point colour",
            .source =
                "Roettger, Irion & Ertl 2002, \"Shadow Volumes Revisited\": counting by blending",
            .needs = "blending into an R32F colour buffer",
            .cost = 1.09,
            .fails_at = {Cause::precision, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe,
            .counts_in_sum = true};
}

} // namespace shadowproof
