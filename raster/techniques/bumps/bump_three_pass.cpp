#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Bumps as lit by the GeForce 256 and 2, which have two textures per pass: ambient light; over it,
/// where it is lit, ambient and diffuse light; all of it times the decal; and the highlight added
/// where it is lit. Between passes the colour has 8 bits per channel, and nothing exceeds 1.
/// Vectors are normalised by a cube map; interpolated normals of the normal map are not normalised
/// again.
///
/// The diffuse pass clamps at 1 what the truth first multiplies by a darker decal. The pass of the
/// highlight looks up H alone: H's self-shadowing dims it, not L's, which the rule has.
LightingRecipe lighting(const Plan& plan) {
    using Step = LightingStep;
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::three_passes,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map};
    LightingRecipe made{
        .steps = {{.fragment = shader_file("ambient_alone.frag")},
                  {.fragment = shader_file("bump_diffuse.frag"), .where = Step::Where::lit},
                  {.fragment = shader_file("decal.frag"), .blend = Step::Blend::multiply},
                  {.fragment = shader_file("bump_specular.frag"),
                   .where = Step::Where::lit,
                   .blend = Step::Blend::add}},
        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_three_pass_technique() {
    return {.name = "bump_three_pass",
            .summary = "zfail_reversed, and bumps lit in three passes of 8 bits a channel",
            .source = "Kilgard 2001 (GeForce 256 and GeForce2)",
            .needs = "bump maps, and blending into an RGBA8 colour buffer",
            .cost = 4.7,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::shading},
            .by_nature = {Cause::shading},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
