#include "raster/technique.h"
#include "raster/volumes/near_cap.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass with volumes capped on the near plane; the caps are drawn at depths reserved in front of
/// the scene. They count the faces between eye and near plane, which are clipped.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zpass_recipe(scene);
    made.counting.start = Counting::Start::near_plane;
    made.counting.flips = {.around_light = true};
    made.flipped = plan.around_light;
    made.near_plane = NearPlane::capped;
    made.depth_model.front = ledge;
    return made;
}

} // namespace

Technique zpass_capped_technique() {
    return {.name = "zpass_capped",
            .summary = "zpass with volumes capped on the near plane",
            .source = "Kilgard 2001, \"A New Robust Technique\"",
            .needs = "a finite projection, and a CPU that cuts volumes",
            .cost = 1.14,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
