// The colour that lighting makes of its inputs: as a technique's arithmetic has it, step by step,
// and how far a technique may be from the truth by roundings alone.
#pragma once

#include "compare/lighting_inputs.h"

namespace shadowproof {

/// What a technique's colour owes to one of its ways, where that is not the truth's.
enum class ColorTerm : std::uint8_t {
    normalisation, ///< vectors that are not quite of unit length
    bump_form,     ///< small normals kept in another form, or not of unit length
    steps,         ///< 8 bits a channel
    self_shadow,   ///< the highlight is dimmed where the light grazes the surface
    clamping,      ///< more than 1, cut off before the decal
};
inline constexpr std::array all_color_terms{ColorTerm::normalisation, ColorTerm::bump_form,
                                            ColorTerm::steps, ColorTerm::self_shadow,
                                            ColorTerm::clamping};
std::string_view name_of(ColorTerm term); ///< "self_shadow"

/// The colours that the technique's own arithmetic may leave: linear; where bits are few, in [0,
/// 1].
Intervals foreseen_color(const ColorModel& model, const LightingInputs& claimed);

/// The colours that are no further from the truth than what the technique rounds explains: the
/// definition in shading.h, carried out with the technique's stages, each of which is off by up to
/// half a step where the technique keeps 8 bits; of inputs that are anywhere between the truth's
/// and the technique's, whose vectors are off by what its normalisation leaves, and whose small
/// normals by what their form and its mixing do. Where bits are few, cut off at 0 and 1.
Intervals color_bound(const ColorModel& model, const LightingInputs& truth,
                      const LightingInputs& claimed);

/// What this one way, alone, moves the colour by, at most in a channel.
double weight_of(ColorTerm term, const ColorModel& model, const LightingInputs& truth,
                 const LightingInputs& claimed);

/// The truth's colour, as a technique of this model can show it: within [0, 1] where bits are few.
glm::dvec3 showable(const ColorModel& model, const glm::dvec3& color);

} // namespace shadowproof
