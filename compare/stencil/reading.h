// One value that a pixel's counter may have within its edge band, and how it comes about.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

struct Reading {
    std::int64_t count = 0;   ///< before wrapping
    std::int64_t ideal = 0;   ///< the surface's shadow depth: what the count should be
    bool in_cone = true;      ///< the point is in the light's cone, if it is a spot
    bool by_rounding = false; ///< only if depths are rounded so, or slivers snapped
    bool by_depth = false;    ///< only if depths of faces are rounded so
    bool by_planes = false;   ///< only where the planes that cut surfaces are
    /// The ray whose faces were counted, and the view depth of the surface shown there.
    glm::dvec3 line{0, 0, 0};
    double depth = 0;
    /// Sum of the faces counted less that of the ray's own faces, in a counter without limits.
    std::int64_t off_ray = 0;
    /// What faces add that are counted, or lost, as the near or the far plane is rounded.
    std::int64_t by_near = 0;
    std::int64_t by_far = 0;
};

/// Puts readings in order and drops repetitions. Those that differ in nothing but their ray count
/// as one.
void sort_out(std::vector<Reading>& readings);

} // namespace shadowproof
