// The error budget of colours: how far from the truth the inputs of a technique's lighting may be,
// given its ColorModel. It starts from the truth's inputs and ignores the contents of the
// technique's tables. It has these parts and no others:
//
//  - normalisation: none where vectors are divided by their length; else the error of a cube map of
//    n texels and 8 bits, or of one Newton-Raphson step. It applies to the vectors to light and eye
//    and to the half-angle vector, each by itself. No other part allows a length other than 1.
//  - bumps: half a step of the texels' format, and the choice of what is filtered bilinearly,
//    slopes or normals, by the form of the bump map: the perturbed normal may point anywhere
//    between both. It is normalised: a filtered normal that is left shorter is not in the budget.
//  - interpolation: values may be those of any place that the rasterizer may draw, and are rounded.
//  - floats: their roundings, as counted beside each step.
//
// Rounding to bytes between stages is not part of it: see color_bound in lighting_arithmetic.h.
#pragma once

#include "compare/driver/lighting/lighting_inputs.h"

#include <glm/vec3.hpp>

namespace shadowproof {

/// Largest distance between the normalised vector and its lookup in a normalisation cube map
/// (`size` texels a side, 8 bits per component), over `vectors`.
double cube_budget(int size, const Intervals& vectors);

/// Relative error in the length of a vector normalised by one Newton-Raphson step: too short by at
/// most this, never too long (Lomont 2003). A guess off by a share e comes out off by 1.5 e^2 +
/// 0.5 e^3, and e is least at -0.034376. Held for all mantissas of two binades, which are all there
/// are, by tests/raster/lighting/normalise_test.cpp.
inline constexpr double newton_raphson_budget = 0.0017523;

/// The truth's inputs, widened by all that the budget allows.
LightingInputs budgeted_inputs(const LightingTables& tables, const InputPoint& point);

} // namespace shadowproof
