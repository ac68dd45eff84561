#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed with volumes from a half-edge mesh: each edge once, with both its triangles. Open
/// casters are closed first, as the source requires, by triangles that only cast.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.extruder = by_half_edges;
    made.sides = VolumeFaces::Sides::half_edges;
    made.counting.dark_cap = plan.dark_cap || plan.hole_filling;
    made.counting.holes_filled = plan.hole_filling;
    return made;
}

} // namespace

Technique zfail_half_edge_technique() {
    return {.name = "zfail_half_edge",
            .summary = "zfail_reversed with silhouettes of a half-edge mesh, holes filled",
            .source = "VGP353 week 5, half-edge meshes",
            .needs = "a half-edge mesh; holes are filled",
            .cost = 0.99,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
