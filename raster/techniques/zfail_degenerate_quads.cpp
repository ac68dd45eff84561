#include "raster/stencil.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// zfail_reversed with volumes that lie ready for any light: a quad over every edge, which the
/// vertex shader stretches out where the light passes between the edge's triangles.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    StencilRecipe recipe = zfail_reversed_recipe(scene, plan);
    recipe.making = VolumeMaking::degenerate_quads;
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique zfail_degenerate_quads_technique() {
    return {.name = "zfail_degenerate_quads",
            .summary = "zfail_reversed with a quad an edge, extruded by the vertex shader",
            .source = "VGP353 week 5, degenerate quads",
            .needs = "both triangles of each edge, known beforehand",
            .cost = 1.5,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .run = run};
}

} // namespace shadowproof
