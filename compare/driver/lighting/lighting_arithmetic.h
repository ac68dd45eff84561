// Computes colours from lighting inputs, as intervals: those that a technique's own arithmetic
// gives, step by step, and those that its error budget allows around the truth.
#pragma once

#include "compare/driver/lighting/lighting_inputs.h"

namespace shadowproof {

/// A step of a technique's lighting that differs from the truth's, and so changes the colour.
enum class ColorTerm : std::uint8_t {
    normalisation, ///< vectors that are only approximately normalised
    vertices,      ///< vectors that are made at vertices and interpolated
    tangents,      ///< vectors that are carried by polygons' tangents
    bump_form,     ///< direction of perturbed normals that are stored and filtered in another form
    bump_length,   ///< length of perturbed normals that filtering leaves shorter or longer than 1
    steps,         ///< rounding to 8 bits per channel
    self_shadow,   ///< the highlight is dimmed by the self-shadowing of another vector
    clamping,      ///< values above 1 are clamped before the decal
    interpolation, ///< snapping, and rounding of interpolated values
};
inline constexpr std::array all_color_terms{
    ColorTerm::normalisation, ColorTerm::vertices,    ColorTerm::tangents,
    ColorTerm::bump_form,     ColorTerm::bump_length, ColorTerm::steps,
    ColorTerm::self_shadow,   ColorTerm::clamping,    ColorTerm::interpolation};
using ColorTerms = std::array<double, all_color_terms.size()>; ///< one number per term
std::string_view name_of(ColorTerm term);                      ///< "self_shadow"

/// The colours that the technique's own arithmetic may give, linear. Within [0, 1] where it keeps 8
/// bits.
Intervals predicted_color(const ColorModel& model, const LightingInputs& claimed);

/// The colours that the error budget (error_budget.h) explains: the definition in shading.h,
/// evaluated in the technique's stages. Where the technique keeps 8 bits, each stage is off by up
/// to half a step, and the colour is clamped to [0, 1].
Intervals color_bound(const ColorModel& model, const LightingInputs& budgeted);

/// Whether a technique of this model is off by nature on the scene, whatever its numbers: its
/// vectors are not made as the truth's are; or heights are in units of space, and it takes all
/// texels for squares of one size, as tangent space and normal maps do.
bool is_off_by_nature(const ColorModel& model, const Scene& scene);

/// Whether the technique uses floats alone, without bytes and tables, and is not off by nature. A
/// colour of such a technique is wrong if it is beyond 1/255 of the truth.
bool is_exact(const ColorModel& model, const Scene& scene);

/// How far each term alone moves the colour, in the channel that it moves most. `truth`, `single`,
/// `claimed`: inputs at the pixel's centre; `freed`: claimed inputs over all that the rasterizer
/// may draw there.
ColorTerms weights_of(const ColorModel& model, const LightingInputs& truth,
                      const SingleStepInputs& single, const LightingInputs& claimed,
                      const LightingInputs& freed);

/// The truth's colour as a technique of this model can show it: clamped to [0, 1] where it keeps 8
/// bits.
glm::dvec3 showable(const ColorModel& model, const glm::dvec3& color);

} // namespace shadowproof
