#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed without light caps: volumes are open towards the light.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.counting.light_cap = false;
    return made;
}

} // namespace

Technique zfail_no_light_cap_technique() {
    return {
        .name = "zfail_no_light_cap",
        .summary = "zfail_reversed without light caps",
        .source = "what Everitt & Kilgard 2002 say is needed, left out",
        .needs = "rays that pass no light cap behind the surface",
        .cost = 0.78,
        .fails_at = {Cause::cap, Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
        .by_nature = {Cause::cap},
        .depth_model = reversed_depths,
        .sees_in_parallel = true,
        .recipe = recipe};
}

} // namespace shadowproof
