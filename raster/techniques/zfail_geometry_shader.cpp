#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// zfail_reversed with volumes made by a geometry shader, which knows a triangle's neighbours.
StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.making = VolumeMaking::geometry_shader;
    return made;
}

} // namespace

Technique zfail_geometry_shader_technique() {
    return {.name = "zfail_geometry_shader",
            .summary = "zfail_reversed with volumes made by a geometry shader from adjacency",
            .source = "omni-directional shadows with geometry shaders",
            .needs = "geometry shaders, and triangles with adjacency",
            .cost = 1.14,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
