// A sphere around all that a scene shows.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

struct Sphere {
    glm::dvec3 centre{0, 0, 0};
    double radius = 0;
};

/// Around the bounding box's centre; the radius reaches the furthest vertex. Throws Error where all
/// vertices lie at one point.
Sphere bounding_sphere(const Scene& scene);

} // namespace shadowproof
