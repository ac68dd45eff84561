// The steps of a technique's lighting that differ from the truth's, and how far each moves a
// colour.
#pragma once

#include "compare/driver/lighting/lighting_inputs.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

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
    filtering,     ///< what stands for the bumps and decals of a pixel is not their mean light
    surroundings,  ///< the pixel also covers another mesh, or is lit in part
};
inline constexpr std::array all_color_terms{
    ColorTerm::normalisation, ColorTerm::vertices,  ColorTerm::tangents,    ColorTerm::bump_form,
    ColorTerm::bump_length,   ColorTerm::steps,     ColorTerm::self_shadow, ColorTerm::clamping,
    ColorTerm::interpolation, ColorTerm::filtering, ColorTerm::surroundings};
using ColorTerms = std::array<double, all_color_terms.size()>; ///< one number per term
std::string_view name_of(ColorTerm term);                      ///< "self_shadow"

/// Inputs of each light that is added up: the true ones and the claimed ones at the pixel's centre,
/// and the claimed ones over all that the rasterizer may draw there.
struct ColorSteps {
    AddedInputs truth;
    std::span<const SingleStepInputs> single;
    AddedInputs claimed;
    AddedInputs freed;
};
/// How far each term alone, under all lights at once, moves the colour, in the channel that it
/// moves most, of a technique whose colours stand for the pixel's centre.
ColorTerms weights_of(const ColorModel& model, const ColorSteps& steps);

/// Means over a pixel: of all its rays, and of those that are like its centre's.
struct PixelColors {
    glm::dvec3 all{0, 0, 0};
    glm::dvec3 alike{0, 0, 0};
};
/// The same of one whose colours stand for all of the pixel. Its bumps are not those of the centre:
/// how they are stored is part of `filtering`.
ColorTerms weights_of(const ColorModel& model, const ColorSteps& steps, const PixelColors& means);

} // namespace shadowproof
