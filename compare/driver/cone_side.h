// On which side of a spot light's cone a surface lies that is shown at a pixel, as far as its
// interpolated place tells.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/scene.h"

#include <cstdint>

namespace shadowproof {

struct ConeSides {
    bool inside = true;
    bool outside = false;
};

/// Where a shader may put the point of a triangle that the pixel's centre sees: inside or outside
/// the cone of the chosen light. Lights that are no spots shine everywhere. `far`: the far plane of
/// what is drawn.
ConeSides cone_sides(const Scene& scene, const DepthModel& model, double far,
                     std::uint32_t triangle, int x, int y);

} // namespace shadowproof
