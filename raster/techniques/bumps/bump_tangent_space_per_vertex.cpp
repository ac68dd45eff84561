#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

Technique bump_tangent_space_technique();

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
    Technique made = bump_tangent_space_technique();
    made.name = "bump_tangent_space_per_vertex";
    made.summary = "zfail_reversed, and bumps lit in tangent space per vertex, in floats";
    made.source = "CS448 lecture 11, fast algorithm";
    made.cost = 3.8;
    made.fails_at.push_back(Cause::shading);
    made.by_nature = {Cause::shading};
    made.lighting = lighting;
    return made;
}

} // namespace shadowproof
