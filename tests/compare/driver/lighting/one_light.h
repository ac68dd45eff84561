// The arithmetic of lighting under a single light.
#pragma once

#include "compare/driver/lighting/lighting_arithmetic.h"

namespace shadowproof::tests {

inline Intervals predicted_by_one(const ColorModel& model, const LightingInputs& claimed) {
    return predicted_color(model, {&claimed, 1});
}

inline Intervals bound_by_one(const ColorModel& model, const LightingInputs& budgeted) {
    return color_bound(model, {&budgeted, 1});
}

} // namespace shadowproof::tests
