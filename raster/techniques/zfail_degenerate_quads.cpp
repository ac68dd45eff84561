#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed with volumes prepared for any light position: a quad per edge, which the vertex
/// shader extrudes where one of the edge's triangles faces the light and the other does not.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.making = VolumeMaking::degenerate_quads;
    return made;
}

} // namespace

Technique zfail_degenerate_quads_technique() {
    return {.name = "zfail_degenerate_quads",
            .summary = "zfail_reversed with a quad an edge, extruded by the vertex shader",
            .source = "VGP353 week 5, degenerate quads",
            .needs = "both triangles of each edge, known beforehand",
            .cost = 1.42,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
