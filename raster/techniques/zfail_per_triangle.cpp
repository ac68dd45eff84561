#include "raster/stencil.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// zfail_reversed with a volume for each light-facing triangle by itself: nothing has to be known
/// of neighbours, and the most is drawn.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    StencilRecipe recipe = zfail_reversed_recipe(scene);
    recipe.extruder = by_triangles;
    recipe.counting.dark_cap = plan.dark_cap;
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique zfail_per_triangle_technique() {
    return {.name = "zfail_per_triangle",
            .summary = "zfail_reversed with one volume for each light-facing triangle",
            .source = "techniques without adjacency; VGP353 week 5",
            .needs = "nothing of the mesh",
            .cost = 7.09,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .run = run};
}

} // namespace shadowproof
