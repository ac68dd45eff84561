// Shadow volumes built on the CPU: caps and extruded sides as triangles over the scene's positions.
// The meshes may be any polygon soup: edges are extruded by their net surplus, so the volumes have
// no cracks.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof {

/// The faces of a shadow volume as triangles, counter-clockwise from outside. With n positions in
/// the scene, corner i < n is position i, and corner i + n the same position moved away from the
/// light to the volume's far end. The light cap has the corners of the scene's own triangles, so
/// that its depth is bit for bit that of the surface.
struct ShadowVolume {
    std::vector<std::uint32_t> facing; ///< indices of the triangles that face the light, in order
    std::vector<glm::uvec3> light_cap; ///< those triangles, except special ones (SpecialCaps)
    std::vector<glm::uvec3> sides;     ///< two for each silhouette edge and unit of its surplus
    /// Flipped sides, of edges that run the other way: clockwise from outside. Coincident sides are
    /// then the same triangles, and rasterize alike bit for bit, whichever triangle they belong to.
    std::vector<glm::uvec3> flipped_sides;
    std::vector<glm::uvec3> flipped_caps; ///< light caps that are flipped, too
    std::vector<glm::uvec3> dark_cap;     ///< the light cap at the far end, wound in reverse
};

/// Indices of the triangles that face the chosen light, in order. All triangles cast, whatever
/// their material.
std::vector<std::uint32_t> triangles_facing_light(const Scene& scene);

/// Makes the volume for the light's position at the time of the call; all that does not depend on
/// it has been prepared. Keeps a reference to the scene.
using Extruder = std::function<ShadowVolume()>;

/// From the silhouette edges of all light-facing triangles together (Kilgard 2001, possible
/// silhouettes). An edge whose surplus is k > 0 gets k quads. Among equal positions, sides use the
/// first.
Extruder by_silhouettes(const Scene& scene);

/// From the silhouette edges of a half-edge mesh of the whole scene (VGP353 week 5): edges of which
/// one triangle faces the light and the other, if there is one, does not.
Extruder by_half_edges(const Scene& scene);

/// One volume per light-facing triangle. A side between two such triangles is drawn twice, in
/// opposite directions, and cancels in the counter.
Extruder by_triangles(const Scene& scene);

/// Exceptions for light caps, one flag per triangle of the scene; empty: none.
struct SpecialCaps {
    std::vector<std::uint8_t> hidden; ///< not drawn
    /// The triangle was flipped (its first two corners exchanged). Its cap is drawn with the
    /// original winding, among the flipped faces, so that its depths are those of its surface even
    /// where it is clipped.
    std::vector<std::uint8_t> flipped;
};
Extruder with_special_caps(Extruder extruder, SpecialCaps special);

/// Applies `special` to the light caps of a volume, which must be those of all `facing` triangles.
void set_special_caps(const SpecialCaps& special, ShadowVolume& volume);

/// Appends the two triangles of the side over the edge from a to b of a triangle that faces the
/// light: to `sides` where a < b, else to `flipped_sides`.
void append_side(std::uint32_t a, std::uint32_t b, std::uint32_t position_count,
                 ShadowVolume& volume);

} // namespace shadowproof
