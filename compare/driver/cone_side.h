// On which side of a spot light's cone a surface lies that is shown at a pixel, as far as its
// interpolated place tells.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/scene.h"

#include <cstdint>

namespace shadowproof {

/// Whether the cone of the chosen light, a spot, may pass between the point of a triangle that the
/// pixel's centre sees and where a shader puts it. `far`: the far plane of what is drawn.
bool cone_may_pass(const Scene& scene, const DepthModel& model, double far, std::uint32_t triangle,
                   int x, int y);

} // namespace shadowproof
