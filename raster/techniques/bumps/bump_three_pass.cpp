#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Bumps as lit by the GeForce 256 and 2, which have two textures and two register combiners per
/// pass: ambient light; over it, where it is lit, ambient and diffuse light; all of it times the
/// decal; and the highlight added where it is lit. Between stages a number has 8 bits and a sign,
/// between passes a colour has 8 bits per channel, and nothing exceeds 1. Light and half-angle
/// vector are carried into tangent space at the vertices, in any length, and interpolated; each is
/// then looked up once in a normalisation cube map. Interpolated normals of the normal map are not
/// normalised again.
///
/// The diffuse pass clamps at 1 what the truth first multiplies by a darker decal. The pass of the
/// highlight looks up H alone: H's self-shadowing dims it, not L's, which the rule has. Three
/// squarings make its eighth power, and no other (two_stages.glsl).
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::two_stages,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map,
                               .vectors = VectorOrigin::at_vertices};
    LightingRecipe made{.steps = three_passes(shader_file("bump_diffuse_two_stages.frag"),
                                              shader_file("bump_specular_two_stages.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_three_pass_technique() {
    return {.name = "bump_three_pass",
            .summary = "zfail_reversed, and bumps lit in three passes of 8 bits a channel",
            .source = "Kilgard 2001 (GeForce 256 and GeForce2)",
            .needs = "bump maps, and blending into an RGBA8 colour buffer",
            .cost = 4.8,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha,
                         Cause::shading},
            .by_nature = {Cause::shading},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .squares_thrice = true,
            .sees_in_parallel = true,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "vectors", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
