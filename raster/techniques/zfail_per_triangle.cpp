#include "raster/stencil.h"
#include "raster/technique.h"
#include "scenes/counted_casters.h"

namespace shadowproof {

namespace {

/// zfail_reversed with a volume for each triangle by itself: nothing has to be known of neighbours,
/// and the most is drawn. Those averted from the light are turned round where the light-facing ones
/// alone would not throw all shadows: any polygon soup throws its own, but for a closed shell that
/// crosses itself.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    StencilRecipe recipe = zfail_reversed_recipe(scene, plan);
    recipe.extruder = by_triangles;
    recipe.counting.turned = triangles_to_turn(scene);
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique zfail_per_triangle_technique() {
    return {.name = "zfail_per_triangle",
            .summary = "zfail_reversed with one volume for each triangle",
            .source = "techniques without adjacency; VGP353 week 5",
            .needs = "nothing of the mesh",
            .cost = 6.1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .run = run};
}

} // namespace shadowproof
