// Tangents as skinned polygon models were given them: polygon by polygon.
#pragma once

#include "scenes/scene.h"

#include <vector>

namespace shadowproof {

/// The three corners' surfaces of each triangle, as Scene::surfaces, with the tangents of the
/// triangles' plane equations (Kilgard 2001; plane_equations.h) in place of those at the vertices:
/// unit, along the rows of the bump map, and the same at all three corners. So neighbours that
/// share a vertex do not share its tangent. Handedness and normals stay the vertices', and lighting
/// turns a tangent into the plane across its corner's normal; the bitangent is at right angles to
/// both. The slides take the other equations' direction for it and "resize" the frame to match the
/// vertex's normal, without saying how: where a picture is skewed, theirs is no right-angled frame.
/// A triangle without area in space or in the texture keeps the
/// tangents that it has, as does one without a bump map.
std::vector<Surface> surfaces_with_polygon_tangents(const Scene& scene);

} // namespace shadowproof
