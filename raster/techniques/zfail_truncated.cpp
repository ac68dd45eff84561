#include "raster/technique.h"
#include "raster/volumes/stencil.h"
#include "scenes/mesh/extrusion.h"

namespace shadowproof {

namespace {

/// zfail_reversed with finite volumes: extruded by half the diagonal of the scene's bounding box,
/// or as far as was asked for, and capped there.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.counting.dark_cap = true; // at the finite end
    made.counting.extrusion = finite_extrusion(scene, plan.asked.volumes);
    return made;
}

} // namespace

Technique zfail_truncated_technique() {
    return {.name = "zfail_truncated",
            .summary = "zfail_reversed with volumes extruded by a finite distance",
            .source = "Kilgard 2001, truncated and capped volumes",
            .needs = "shadows that end within the distance",
            .cost = 0.95,
            .fails_at = {Cause::extrusion, Cause::precision, Cause::counter, Cause::open_mesh,
                         Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .settings = {"extrusion"},
            .recipe = recipe};
}

} // namespace shadowproof
