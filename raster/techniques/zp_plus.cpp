#include "raster/technique.h"
#include "raster/volumes/near_plane.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass, after the occluders between light and near plane are drawn from the light, through that
/// plane: one layer for each volume in which a pixel's ray begins. Where the light is so near the
/// plane that floats cannot project onto it, from the number of volumes around the eye.
Frame run(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe recipe = zpass_recipe(scene);
    const bool is_projected = places_occluders(scene);
    recipe.counting.start = is_projected ? Counting::Start::near_plane : Counting::Start::eye;
    if (is_projected) recipe.near_plane = NearPlane::from_light;
    Frame frame = draw_stencil_shadows(gpu, scene, recipe);
    if (!is_projected)
        frame.left_out = {
            "the near plane's occluders: the light is so near that plane, or a caster, that floats "
            "cannot project onto it"};
    return frame;
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
            .depth_model = finite_depths,
            .run = run};
}

} // namespace shadowproof
