#include "raster/technique.h"
#include "raster/volumes/near_cap.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass with volumes capped on the near plane; the caps are drawn at depths reserved in front of
/// the scene. They count the faces between eye and near plane, which are clipped.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    StencilRecipe recipe = zpass_recipe(scene);
    recipe.counting.start = Counting::Start::near_plane;
    recipe.counting.flips = {.around_light = true};
    recipe.flipped = plan.around_light;
    recipe.near_plane = NearPlane::capped;
    recipe.depth_model.front = ledge;
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique zpass_capped_technique() {
    return {.name = "zpass_capped",
            .summary = "zpass with volumes capped on the near plane",
            .source = "Kilgard 2001, \"A New Robust Technique\"",
            .needs = "a finite projection, and a CPU that cuts volumes",
            .cost = 1.14,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .depth_model = finite_depths,
            .run = run};
}

} // namespace shadowproof
