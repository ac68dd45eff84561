// The error budget of colours: how far from the truth the inputs of a technique's lighting may be,
// given its ColorModel. It starts from the truth's inputs and ignores the contents of the
// technique's tables. It has these parts and no others:
//
//  - normalisation: none where vectors are divided by their length; else the error of a cube map of
//    n texels and 8 bits, or of Newton and Raphson's steps. It applies to the vectors to light and
//    eye and to the half-angle vector, each by itself. No other part allows a length other than 1.
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

/// By which share a length is off: at least `low`, at most `high`.
struct LengthError {
    double low = 0;
    double high = 0;
};

/// Of a vector normalised by Newton-Raphson steps from a guess by the float's bits (Lomont 2003),
/// in exact arithmetic. The guess is off by -0.034376 to 0.033961. A step makes of a share e the
/// share -1.5 e^2 - 0.5 e^3, which is largest, and 0, at e = 0, and falls to both sides of it: it
/// is least at one of the ends. So one step leaves -0.0017523 to 0, two -4.61e-6 to 0. Held for all
/// mantissas of two binades, which are all there are, by tests/raster/lighting/normalise_test.cpp.
constexpr LengthError newton_raphson_error(int steps) {
    LengthError error{-0.034376, 0.033961};
    const auto stepped = [](double e) { return -e * e * (1.5 + 0.5 * e); };
    for (int step = 0; step < steps; ++step) {
        const double low = stepped(error.low);
        const double high = stepped(error.high);
        error = {low < high ? low : high, 0};
    }
    return error;
}

/// The truth's inputs, widened by all that the budget allows.
LightingInputs budgeted_inputs(const LightingTables& tables, const InputPoint& point);

} // namespace shadowproof
