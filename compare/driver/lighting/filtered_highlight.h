// Highlights of filtered bumps, as ranges (raster/glsl/lighting/filtered.glsl).
#pragma once

#include "compare/driver/lighting/lighting_inputs.h"

namespace shadowproof {

/// The highlight without any self-shadowing. Of bumps that no filter widens: (H . N')^s.
Interval highlight_range(const LightingInputs& in);

} // namespace shadowproof
