#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// The steps of bump_three_pass by the arithmetic of later hardware: light and half-angle vector
/// are made at each pixel, and a pass is computed in floats. What is left of that technique's error
/// is its bytes between passes, its cube map, its normals that are not normalised again, its
/// clamping and its dimming of the highlight.
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

Technique bump_three_pass_per_pixel_technique() {
    return {.name = "bump_three_pass_per_pixel",
            .summary = "bump_three_pass with vectors made at each pixel, and floats in a pass",
            .source = "Kilgard 2001 (GeForce 256 and GeForce2)",
            .needs = "bump maps, and blending into an RGBA8 colour buffer",
            .cost = 5.1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::shading},
            .by_nature = {Cause::shading},
            .needs_bump_maps = true,
            .depth_model = reversed_depths,
            .settings = {"normalise", "cube-size", "newton-steps", "bumps", "vectors", "tangents"},
            .recipe = zfail_reversed_recipe,
            .lighting = lighting};
}

} // namespace shadowproof
