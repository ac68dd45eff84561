// What lighting needs at the corners of a primitive's triangles: normals, tangents and texture
// coordinates, posed like the positions and brought to world space.
#pragma once

#include "scenes/load/gltf/attribute.h"
#include "scenes/load/gltf/material.h"
#include "scenes/load/gltf/skin.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowproof::gltf {

/// A posed primitive, still in the mesh's own space.
struct PosedPart {
    const Part& part;
    const std::vector<double>& weights; ///< of morph targets
    const Elements& positions;          ///< the mesh's own space, morphed
    const std::vector<glm::uvec3>& triangles;
    const glm::dmat4& world_from_node;
    const std::optional<Skin>& skin;
    const std::optional<Influences>& influences; ///< where there is a skin
    bool mirrored = false; ///< the second and third corner of each triangle change places
};

/// Appends three per triangle to scene.surfaces. M maps from the mesh's space to the world at a
/// vertex (by its joints, where it is skinned). A normal is transformed by the inverse transpose of
/// M and a tangent by M, both then normalised. The bitangent goes with the surface, so w changes
/// sign where M mirrors.
///
/// Without NORMAL each triangle is flat, and TANGENT is ignored (glTF 2.0, section 3.7.2.1);
/// without TANGENT make_tangents makes them, in the mesh's space as morphed (section 3.7.2.2).
/// Where the material has no bump map there are no tangents. Refused: a texture without its
/// coordinates, a tangent whose w is not 1 or -1.
void append_surfaces(AccessorReader& reader, const PosedPart& posed, const Material& material,
                     const CoordinateSets& sets, Scene& scene);

/// The normals of all vertices, likewise in world space; empty without NORMAL. 0 where one has no
/// length.
std::vector<glm::vec3> world_normals(AccessorReader& reader, const PosedPart& posed);

/// The coordinates of a texture at all vertices of a primitive, morphed, transformed and rounded to
/// float. `what`: whose texture it is, for messages. Refused: a texture without its coordinates.
std::vector<glm::vec2> texture_coordinates(AccessorReader& reader, const Part& part,
                                           const std::vector<double>& weights, std::size_t vertices,
                                           const Coordinates& from, const char* what);

} // namespace shadowproof::gltf
