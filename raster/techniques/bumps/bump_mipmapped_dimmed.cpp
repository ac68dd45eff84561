#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// As bump_mipmapped. Alpha holds how long the mean normal is, and dims the diffuse term, as the
/// mean of cosines is less than the cosine with the mean's direction. Where all the bumps under a
/// pixel face the light, that is exact: a mean of L . N is L times the mean of N. Highlights are as
/// bump_mipmapped has them.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.filter = BumpFilter::dimmed};
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_filtered.frag"),
                                                    shader_file("ambient_filtered.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_mipmapped_dimmed_technique() {
    return {
        .name = "bump_mipmapped_dimmed",
        .summary = "bump_mipmapped, its diffuse light dimmed where bumps are averaged",
        .source = "Kilgard 2001 (dimFactor)",
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
