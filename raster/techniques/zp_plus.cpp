#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass, after the occluders between light and near plane are drawn from the light, through that
/// plane: one layer for each volume in which a pixel's ray begins.
Frame run(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe recipe = zpass_recipe(scene);
    recipe.counting.start = Counting::Start::near_plane;
    recipe.near_plane = NearPlane::from_light;
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique zp_plus_technique() {
    return {.name = "zp_plus",
            .summary = "zpass after drawing the near plane's occluders from the light",
            .source = "Hornus, Hoberock, Lefebvre & Hart 2005, ZP+",
            .needs = "a light that does not lie in the near plane",
            .cost = 0.99,
            .fails_at = {Cause::near_plane, Cause::precision, Cause::counter, Cause::open_mesh,
                         Cause::light_inside},
            .run = run};
}

} // namespace shadowproof
