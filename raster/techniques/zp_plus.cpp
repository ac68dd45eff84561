#include "raster/technique.h"
#include "raster/volumes/near_plane.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass, after the occluders between light and near plane are drawn from the light, through that
/// plane: one layer for each volume in which a pixel's ray begins. Where the light is so near the
/// plane that floats cannot project onto it, from the number of volumes around the eye.
StencilRecipe recipe(const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe made = zpass_recipe(scene);
    const bool is_projected = places_occluders(scene);
    made.counting.start = is_projected ? Counting::Start::near_plane : Counting::Start::eye;
    if (is_projected) made.near_plane = NearPlane::from_light;
    return made;
}

void remark(Gpu& /*gpu*/, const Technique& /*technique*/, const Scene& scene, const Plan& /*plan*/,
            Frame& frame) {
    if (places_occluders(scene)) return;
    frame.left_out = {
        "the near plane's occluders: the light is so near that plane, or a caster, that floats "
        "cannot project onto it"};
}

} // namespace

Technique zp_plus_technique() {
    return {.name = "zp_plus",
            .summary = "zpass after drawing the near plane's occluders from the light",
            .source = "Hornus, Hoberock, Lefebvre & Hart 2005, ZP+",
            .needs = "a light that does not lie in the near plane",
            .cost = 0.99,
            .fails_at = {Cause::near_plane, Cause::precision, Cause::counter, Cause::open_mesh,
                         Cause::alpha, Cause::light_inside},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe,
            .remark = remark};
}

} // namespace shadowproof
