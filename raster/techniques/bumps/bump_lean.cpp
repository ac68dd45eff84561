#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// As bump_mipmapped, with means of slopes and of their products. Those tell variances and
/// covariance of slopes, so that highlights become wider along which way the bumps vary, and darker
/// as they do: the half-angle vector's slope in a Gaussian of these. Of a smooth surface that is a
/// little less than the cosine's power, which falls off slower.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.filter = BumpFilter::lean};
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_filtered.frag"),
                                                    shader_file("ambient_filtered.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_lean_technique() {
    return {
        .name = "bump_lean",
        .summary = "bump_mipmapped from mean slopes, highlights as slopes vary",
        .source = "Olano & Baker 2010 (LEAN mapping)",
        .needs = "bump maps, and blending into an RGBA32F colour buffer; unless named, a file "
                 "that asks for their mipmaps",
        .cost = 0,
        .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha,
                     Cause::shading},
        .by_nature = {Cause::shading},
        .needs_bump_maps = true,
        .filters_bumps = true,
        .depth_model = reversed_depths,
        .settings = {"normalise", "cube-size", "newton-steps", "vectors", "tangents", "anisotropy"},
        .recipe = zfail_reversed_recipe,
        .lighting = lighting};
}

} // namespace shadowproof
