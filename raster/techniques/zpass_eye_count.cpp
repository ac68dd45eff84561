#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass with the stencil cleared to the number of volumes around the eye: right as long as the
/// near plane lies in the same ones.
StencilRecipe recipe(const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe made = zpass_recipe(scene);
    made.counting.start = Counting::Start::eye;
    return made;
}

} // namespace

Technique zpass_eye_count_technique() {
    return {.name = "zpass_eye_count",
            .summary = "zpass that starts from the number of volumes around the eye",
            .source = "VGP353 week 5",
            .needs = "no volume between the eye and a part of the near plane",
            .cost = 1,
            .fails_at = {Cause::near_plane, Cause::precision, Cause::counter, Cause::open_mesh,
                         Cause::alpha, Cause::light_inside},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
