// How a spot's light falls off from its inner to its outer cone: KHR_lights_punctual's
// recommendation, for truth, technique and judge alike.
#pragma once

#include "scenes/scene.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

/// Towards a direction whose cosine with the axis is c, the light is the square of
/// clamp((c - cos_outer) * scale, 0, 1).
struct SpotCone {
    double cos_outer = 0;
    double scale = 0; ///< 1 / max(0.001, cos inner - cos outer); the extension names the 0.001, by
                      ///< which cones that are as wide as each other divide by no zero
};

inline SpotCone spot_cone(const Light& light) {
    const double cos_outer = std::cos(light.outer_cone);
    return {cos_outer, 1 / std::max(0.001, std::cos(light.inner_cone) - cos_outer)};
}

} // namespace shadowproof
