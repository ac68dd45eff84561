// Shadow volumes made on the CPU as the light moves: caps and extruded sides as triangles over the
// scene's positions. Assumes nothing of the meshes: edges count by their net surplus, so any
// polygon soup gets a boundary without cracks.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof {

/// Corners of triangles, counter-clockwise from outside the volume. With n positions in the scene,
/// corner i < n is position i, and corner i + n the same moved away from the light to the volume's
/// far end. The light cap's corners are the very ones of the scene's triangles, so that its depth
/// is bit for bit that of the surface.
struct ShadowVolume {
    std::vector<std::uint32_t> facing; ///< indices of the triangles that face the light, in order
    std::vector<glm::uvec3> light_cap; ///< those triangles, but for special ones
    std::vector<glm::uvec3> sides;     ///< two for each silhouette edge and unit of its surplus
    /// Sides that run the other way, wound as if they did not: clockwise from outside. Sides that
    /// lie in one place are then the same triangles, and rasterize alike bit by bit, whichever
    /// triangle they stand on.
    std::vector<glm::uvec3> turned_sides;
    std::vector<glm::uvec3> turned_caps; ///< light caps that are wound so, too
    std::vector<glm::uvec3> dark_cap;    ///< the light cap at the far end, wound in reverse
};

/// Indices of the triangles that face the chosen light, in order. Every material casts.
std::vector<std::uint32_t> triangles_facing_light(const Scene& scene);

/// Makes the volume of the chosen light where it is when called; all that does not depend on the
/// light has been prepared. Keeps a reference to the scene.
using Extruder = std::function<ShadowVolume()>;

/// Silhouette edges of all light-facing triangles together (Kilgard 2001, possible silhouettes). An
/// edge whose surplus is k > 0 gets k quads; corners of sides are the first of the positions that
/// are equal.
Extruder by_silhouettes(const Scene& scene);

/// Silhouette edges of a half-edge mesh of the whole scene (VGP353 week 5): those where just one of
/// two triangles faces the light, or the only one does.
Extruder by_half_edges(const Scene& scene);

/// A volume for each light-facing triangle by itself. Sides between two of them lie there twice, in
/// opposite directions, and cancel in the counter.
Extruder by_triangles(const Scene& scene);

/// What is special of the light caps of a scene's triangles, a flag each; empty: of none.
struct SpecialCaps {
    std::vector<std::uint8_t> hidden; ///< not drawn
    /// Of a triangle whose first two corners were exchanged: drawn as it was before, among the
    /// turned ones, so that its depths are those of its surface also where it is clipped.
    std::vector<std::uint8_t> turned;
};
Extruder with_special_caps(Extruder extruder, SpecialCaps special);

/// Sorts the light caps of a volume, those of all `facing` triangles, into those that are drawn.
void set_special_caps(const SpecialCaps& special, ShadowVolume& volume);

/// Appends the two triangles of the side beside the edge from a to b of a triangle that faces the
/// light: to `sides` where a < b, else to `turned_sides`.
void append_side(std::uint32_t a, std::uint32_t b, std::uint32_t position_count,
                 ShadowVolume& volume);

} // namespace shadowproof
