#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Light and half-angle vector are transformed to tangent space, where a normal map's normals are
/// used as they are, in 32-bit floating point and with exact normalisation. Ambient light
/// everywhere, the rest where the stencil of zfail_reversed is zero.
///
/// The lecture and the slides transform the vectors at the vertices and interpolate the results
/// (bump_tangent_space_per_vertex). But a product of two quantities that are linear over a triangle
/// is not linear, so that is right only where the triangle's three frames are equal. Here the frame
/// and the vectors are interpolated, not normalised, and multiplied per pixel.
LightingRecipe lighting(const Plan& plan) {
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_tangent_space.frag")),
                        .model = with_settings({}, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_tangent_space_technique() {
    return {.name = "bump_tangent_space",
            .summary = "zfail_reversed, and bumps lit in tangent space per pixel, in floats",
            .source = "Peercy, Airey & Cabral 1997; with stencil shadows: Kilgard 2001",
            .needs = "bump maps, and blending into an RGBA32F colour buffer",
            .cost = 3.4,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "vectors", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
