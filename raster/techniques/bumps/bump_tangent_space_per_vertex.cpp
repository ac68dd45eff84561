#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// The lecture's fast algorithm: light and half-angle vector are carried into tangent space and
/// normalised at the vertices, interpolated, and normalised again at each pixel, which no longer
/// needs a frame. In 32-bit floating point, so that all that it is wrong by is the interpolation:
/// nothing where a triangle's three frames and directions are equal, much where it is large and
/// bent.
LightingRecipe lighting(const Plan& plan) {
    LightingRecipe made{
        .steps = add_lit_to_ambient(shader_file("bump_tangent_space.frag")),
        .model = with_settings({.vectors = VectorOrigin::unit_at_vertices}, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_tangent_space_per_vertex_technique() {
    return {.name = "bump_tangent_space_per_vertex",
            .summary = "zfail_reversed, and bumps lit in tangent space per vertex, in floats",
            .source = "CS448 lecture 11, fast algorithm",
            .needs = "bump maps, and blending into an RGBA32F colour buffer",
            .cost = 3.8,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::shading},
            .by_nature = {Cause::shading},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "vectors", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
