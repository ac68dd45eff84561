#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// As bump_tangent_space, with normals and decals from mipmaps: trilinear lookups, at the level of
/// which a texel is as large as the pixel. The mean normal is normalised again. That is the normal
/// of a smooth surface: nothing is left of the bumps below a pixel, whose highlights point
/// elsewhere. Averaging normals is not averaging reflections.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.filter = BumpFilter::renormalised};
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_filtered.frag"),
                                                    shader_file("ambient_filtered.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_mipmapped_technique() {
    return {
        .name = "bump_mipmapped",
        .summary = "bump_tangent_space from mean normals, normalised again",
        .source = "Williams 1983; CS448 lecture 11, filtering",
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
