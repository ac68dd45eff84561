// Rooms: scenes whose surfaces face inwards.
#pragma once

#include "scenes/scene.h"

#include <optional>

namespace shadowproof {

struct FirstHit {
    double distance = 0; ///< in lengths of the direction
    bool front = false;  ///< whether the triangle is seen from its front
};

/// The first triangle along a ray, by plain arithmetic in double: for choices that need not be
/// exact. Time is linear in the scene's triangles.
std::optional<FirstHit> first_hit(const Scene& scene, const glm::dvec3& origin,
                                  const glm::dvec3& direction);

/// Whether at least nine of fourteen rays from the middle of the bounding box, along its axes and
/// diagonals, first meet the front of a triangle. From inside a solid body they meet back faces.
bool is_room(const Scene& scene);

} // namespace shadowproof
