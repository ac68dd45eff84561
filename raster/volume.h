// The shadow volume of a scene's light from CPU possible silhouettes (Kilgard 2001): caps and
// extruded sides as triangles over the scene's positions. Assumes nothing of the meshes: edges
// count by their net surplus, so any polygon soup gets a boundary without cracks.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// Corners of triangles, counter-clockwise from outside the volume. With n positions in the scene,
/// corner i < n is position i, and corner i + n the same moved away from the light to infinity
/// (w = 0). The light cap's corners are the very ones of the scene's triangles, so that its depth
/// is bit for bit that of the surface.
struct ShadowVolume {
    std::vector<glm::uvec3> light_cap; ///< the triangles that face the light
    std::vector<glm::uvec3> sides;     ///< two for each silhouette edge and unit of its surplus
    std::vector<glm::uvec3> dark_cap;  ///< the light cap at infinity, wound in reverse
};

/// Positive where a triangle is wound counter-clockwise as seen from the point, negative where
/// clockwise: (b - a) x (c - a) . (point - a) in double. Zero without area or in its plane.
double side(const Scene& scene, std::uint32_t triangle, const glm::dvec3& point);

/// Indices of the triangles that face the light (side > 0), in order. Every material casts.
std::vector<std::uint32_t> triangles_facing_light(const Scene& scene);

/// The volume of the chosen light, which must have a position. An edge whose surplus is k > 0 gets
/// k quads; corners of sides are the first of the positions that are equal.
ShadowVolume extrude(const Scene& scene);

} // namespace shadowproof
