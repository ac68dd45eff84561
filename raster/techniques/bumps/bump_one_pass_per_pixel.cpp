#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// The combiners of bump_one_pass behind light and half-angle vectors that are made at each pixel:
/// against that technique, what interpolating them between vertices costs.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::four_stages,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map};
    LightingRecipe made{.steps = {{.fragment = shader_file("ambient.frag")},
                                  {.fragment = shader_file("bump_four_stages.frag"),
                                   .where = LightingStep::Where::lit}},
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_one_pass_per_pixel_technique() {
    return {.name = "bump_one_pass_per_pixel",
            .summary = "bump_one_pass with vectors made at each pixel",
            .source = "Kilgard 2001 (GeForce3)",
            .needs = "bump maps, and an RGBA8 colour buffer",
            .cost = 3.9,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::shading},
            .by_nature = {Cause::shading},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .squares_thrice = true,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "vectors", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
