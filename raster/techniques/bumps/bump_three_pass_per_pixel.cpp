#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

Technique bump_three_pass_technique();

namespace {

/// The steps of bump_three_pass by the arithmetic of later hardware: light and half-angle vector
/// are made at each pixel, and a pass is computed in floats. What is left of that technique's error
/// is its bytes between passes, its cube map, its normals that are not normalised again, its
/// clamping and its dimming of the highlight.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::three_passes,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map};
    LightingRecipe made{
        .steps = three_passes(shader_file("bump_diffuse.frag"), shader_file("bump_specular.frag")),
        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_three_pass_per_pixel_technique() {
    Technique made = bump_three_pass_technique();
    made.name = "bump_three_pass_per_pixel";
    made.summary = "bump_three_pass with vectors made at each pixel, and floats in a pass";
    made.cost = 5.1;
    made.squares_thrice = false;
    made.lighting = lighting;
    return made;
}

} // namespace shadowproof
