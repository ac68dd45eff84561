#include "raster/technique.h"
#include "raster/volumes/stencil.h"
#include "scenes/mesh/counted_casters.h"

namespace shadowproof {

namespace {

/// zfail_reversed with one volume per triangle: no adjacency is needed, and the most faces are
/// drawn. Triangles that face away from the light are flipped where the light-facing ones alone
/// would not cast all shadows. So any polygon soup casts its shadows, except a closed shell that
/// crosses itself.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.extruder = by_triangles;
    made.counting.flips = {.around_light = true,
                           .averted = Counting::Flips::Averted::of_faulty_shells};
    made.sides = VolumeFaces::Sides::all;
    made.flipped = triangles_to_flip(scene);
    return made;
}

} // namespace

Technique zfail_per_triangle_technique() {
    return {.name = "zfail_per_triangle",
            .summary = "zfail_reversed with one volume for each triangle",
            .source = "techniques without adjacency; VGP353 week 5",
            .needs = "nothing of the mesh",
            .cost = 8.1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
