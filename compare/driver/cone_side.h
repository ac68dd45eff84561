// The side of a spot light's cone on which the surface shown at a pixel lies, within the error of
// its interpolated position.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/scene.h"

#include <cstdint>

namespace shadowproof {

struct ConeSides {
    bool inside = true;
    bool outside = false;
};

/// Whether a shader may place the point of a triangle that the pixel's centre sees inside or
/// outside the cone of the chosen light. Lights that are no spots have no outside. `far`: the far
/// plane of what is drawn.
ConeSides cone_sides(const Scene& scene, const DepthModel& model, double far,
                     std::uint32_t triangle, int x, int y);

} // namespace shadowproof
