#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Bumps as lit by the GeForce3, with four textures and four register combiners: ambient light
/// times the decal, then over it, where it is lit, everything in one pass. Every number has 8 bits
/// and a sign. Light and half-angle vector are carried into tangent space at the vertices, in any
/// length, and interpolated; each is then looked up once in a normalisation cube map. Interpolated
/// normals of the normal map are not normalised again.
///
/// The combiners multiply the highlight by the self-shadowing of L and by that of H; the rule has
/// L's alone. Three squarings make its eighth power, and no other.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::four_stages,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map,
                               .vectors = VectorOrigin::at_vertices};
    LightingRecipe made{.steps = replace_ambient_where_lit(shader_file("bump_four_stages.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_one_pass_technique() {
    return {.name = "bump_one_pass",
            .summary = "zfail_reversed, and bumps lit in one pass of register combiners",
            .source = "Kilgard 2001 (GeForce3)",
            .needs = "bump maps, and an RGBA8 colour buffer",
            .cost = 4.1,
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
