#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed without dark caps: volumes are open at infinity.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.counting.dark_cap = false;
    return made;
}

} // namespace

Technique zfail_no_dark_cap_technique() {
    return {
        .name = "zfail_no_dark_cap",
        .summary = "zfail_reversed without dark caps",
        .source = "what Everitt & Kilgard 2002 say is needed, left out",
        .needs = "rays that leave all volumes again",
        .cost = 0.99,
        .fails_at = {Cause::cap, Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
        .by_nature = {Cause::cap},
        .depth_model = reversed_depths,
        .sees_in_parallel = true,
        .recipe = recipe};
}

} // namespace shadowproof
