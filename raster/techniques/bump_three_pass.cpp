#include "raster/stencil.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// Bumps as the GeForce 256 and 2 light them, which have two textures a pass: ambient light, over
/// it ambient and diffuse light where it is lit, all times the decal, and the highlight added where
/// it is lit. Between passes the colour is kept in 8 bits a channel, and nothing is above 1.
/// Vectors are made of unit length by a cube map, and what is mixed of the normal map not again.
///
/// The diffuse pass clamps at 1 what the truth multiplies by a darker decal before it is shown.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    using Step = LightingStep;
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::three_passes,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map};
    StencilRecipe recipe = zfail_reversed_recipe(scene, plan);
    recipe.lighting = {
        .steps = {{.fragment = shader_file("ambient_alone.frag")},
                  {.fragment = shader_file("bump_diffuse.frag"), .where = Step::Where::lit},
                  {.fragment = shader_file("decal.frag"), .blend = Step::Blend::multiply},
                  {.fragment = shader_file("bump_specular.frag"),
                   .where = Step::Where::lit,
                   .blend = Step::Blend::add}},
        .model = with_settings(model, plan.lighting)};
    return draw_stencil_shadows(gpu, scene, recipe);
}

} // namespace

Technique bump_three_pass_technique() {
    return {.name = "bump_three_pass",
            .summary = "zfail_reversed, and bumps lit in three passes of 8 bits a channel",
            .source = "Kilgard 2001 (GeForce 256 and GeForce2)",
            .needs = "bump maps, and blending into an RGBA8 colour buffer",
            .cost = 4.9,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::shading},
            .by_nature = {Cause::shading},
            .needs_bump_maps = true,
            .run = run};
}

} // namespace shadowproof
