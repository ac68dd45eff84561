#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zpass with a counter of one bit: each face inverts the stencil. Right where volumes do not
/// overlap.
StencilRecipe recipe(const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe made = zpass_recipe(scene);
    made.counting.operation = Counting::Operation::invert;
    return made;
}

} // namespace

Technique invert_technique() {
    return {.name = "invert",
            .summary = "zpass that inverts the stencil instead of counting",
            .source = "Kilgard 2001; CS448 lecture 11, parity",
            .needs = "volumes that do not overlap",
            .cost = 0.91,
            .fails_at = {Cause::parity, Cause::near_plane, Cause::eye_inside, Cause::precision,
                         Cause::open_mesh, Cause::alpha, Cause::light_inside},
            .by_nature = {Cause::parity},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
