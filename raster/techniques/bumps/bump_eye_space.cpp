#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// The normal is perturbed in eye space, in 32-bit floating point and with exact normalisation: by
/// a height field's slopes, N' = N + h_u (N x P_v) + h_v (P_u x N), or by a normal map's normal,
/// transformed to eye space. Ambient light everywhere, the rest where the stencil of zfail_reversed
/// is zero.
LightingRecipe lighting(const Plan& plan) {
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_eye_space.frag")),
                        .model =
                            with_settings({.axes = ColorModel::Axes::eye}, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_eye_space_technique() {
    return {.name = "bump_eye_space",
            .summary = "zfail_reversed, and bumps lit in eye space, in floating point",
            .source = "Blinn 1978; with stencil shadows: Kilgard 2001",
            .needs = "bump maps, and blending into an RGBA32F colour buffer",
            .cost = 4.4,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
