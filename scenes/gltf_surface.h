// What lighting needs at the corners of a primitive's triangles: normals, tangents and texture
// coordinates, posed like the positions and brought to world space.
#pragma once

#include "scenes/gltf_attribute.h"
#include "scenes/gltf_material.h"
#include "scenes/gltf_skin.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowproof::gltf {

/// A primitive as posed, but for the step from the mesh's own space to the world.
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

/// Appends three a triangle to scene.surfaces. With M the map from the mesh's space to the world
/// at a vertex (of its joints, where it is skinned), a normal n becomes that of M's inverse
/// transpose, a tangent M t, each of unit length; the bitangent goes with the surface, so w is
/// turned round where M mirrors.
///
/// Without NORMAL each triangle is flat, and TANGENT is passed over (glTF 2.0, section 3.7.2.1);
/// without TANGENT make_tangents is asked, in the mesh's space as morphed (section 3.7.2.2). Where
/// the material has no bump map there are no tangents. Refused: a texture without its coordinates,
/// a tangent whose w is not 1 or -1.
void append_surfaces(AccessorReader& reader, const PosedPart& posed, const Material& material,
                     const CoordinateSets& sets, Scene& scene);

} // namespace shadowproof::gltf
