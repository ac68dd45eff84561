// Rays through a pixel, other than its centre's.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/camera.h"

#include <glm/vec3.hpp>

namespace shadowproof {

/// Rays of one pixel, through the middles of as many equal rectangles, row by row.
struct SampleRays {
    const Camera& camera;
    int columns = 1;
    int rows = 1;
    int x = 0;
    int y = 0;

    int count() const { return columns * rows; }
    glm::dvec3 at(int sample) const {
        return sight_column(camera, x + (sample % columns + 0.5) / columns) +
               sight_row(camera, y + (sample / columns + 0.5) / rows);
    }
};

} // namespace shadowproof
