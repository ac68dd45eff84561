// How a spot's light falls off from its inner to its outer cone: KHR_lights_punctual's
// recommendation. Used by reference, techniques and verdicts alike.
#pragma once

#include "scenes/scene.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

/// Towards a direction whose cosine with the axis is c, the light is the square of
/// clamp((c - cos_outer) * scale, 0, 1).
struct SpotCone {
    double cos_outer = 0;
    double scale = 0; ///< 1 / max(0.001, cos inner - cos outer); the 0.001 is the extension's, and
                      ///< avoids a division by zero where both cones are equal
};

inline SpotCone spot_cone(const Light& light) {
    const double cos_outer = std::cos(light.outer_cone);
    return {cos_outer, 1 / std::max(0.001, std::cos(light.inner_cone) - cos_outer)};
}

} // namespace shadowproof
