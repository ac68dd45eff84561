#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// As bump_tangent_space and, added to it whether lit or not, the reflection of the scene's
/// environment: the perturbed normal transformed to world space, the eye's direction mirrored at
/// it, and a dependent lookup, all per pixel.
LightingRecipe lighting(const Plan& plan) {
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_tangent_space.frag")),
                        .model = with_settings({.reflects = true}, plan.asked.lighting)};
    made.steps.push_back(add_reflection(shader_file("bump_reflection.frag")));
    return made;
}

} // namespace

Technique bump_reflective_technique() {
    return {.name = "bump_reflective",
            .summary = "bump_tangent_space, and bumps that reflect an environment",
            .source = "CS448 lecture 11, reflective bump mapping",
            .needs = "bump maps, an environment, and blending into an RGBA32F colour buffer",
            .cost = 4.7,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .needs_bump_maps = true,
            .needs_environment = true,
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "vectors", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
