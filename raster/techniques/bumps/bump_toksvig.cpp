#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// As bump_mipmapped. How short the mean normal is tells how much the normals vary, as in a lobe of
/// Gaussian shape, and makes the highlight's exponent smaller and the highlight darker.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.filter = BumpFilter::toksvig};
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_filtered.frag"),
                                                    shader_file("ambient_filtered.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_toksvig_technique() {
    return {
        .name = "bump_toksvig",
        .summary = "bump_mipmapped, highlights wider and darker where bumps are averaged",
        .source = "Toksvig 2005",
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
