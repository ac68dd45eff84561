// Vertex normals from the triangles around each vertex, for models that have none of their own.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// One per vertex, normalised: the sum of the unit normals of the triangles that share it,
/// counter-clockwise from the front, each weighted by its angle there (G. Thuermer and C.
/// Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998). It does not depend on how a
/// face is cut into triangles. A triangle without area counts for nothing; where none counts, or
/// all cancel out, the normal is along z.
std::vector<glm::dvec3> smooth_normals(const std::vector<glm::dvec3>& positions,
                                       const std::vector<glm::uvec3>& triangles);

} // namespace shadowproof
