// How far a scene's clusters reach from a point, leaving out what lies absurdly far out: that is
// what coordinates are scaled by.
#pragma once

#include "reference/walk/clusters.h"

#include <glm/vec3.hpp>

namespace shadowproof {

/// The largest component's distance from `origin` to any corner of a box; of all clusters that are
/// not outlying. Most often, none is.
double reach_of_most(const Clusters& clusters, const glm::dvec3& origin);

/// The scene's centre, outlying clusters left out.
glm::dvec3 center_of_most(const Clusters& clusters);

} // namespace shadowproof
