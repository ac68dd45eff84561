#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

Technique bump_one_pass_technique();

namespace {

/// The combiners of bump_one_pass behind light and half-angle vectors that are made at each pixel:
/// against that technique, what interpolating them between vertices costs.
LightingRecipe lighting(const Plan& plan) {
    constexpr ColorModel model{.arithmetic = ColorModel::Arithmetic::four_stages,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map};
    LightingRecipe made{.steps = replace_ambient_where_lit(shader_file("bump_four_stages.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

} // namespace

Technique bump_one_pass_per_pixel_technique() {
    Technique made = bump_one_pass_technique();
    made.name = "bump_one_pass_per_pixel";
    made.summary = "bump_one_pass with vectors made at each pixel";
    made.cost = 3.9;
    made.lighting = lighting;
    return made;
}

} // namespace shadowproof
