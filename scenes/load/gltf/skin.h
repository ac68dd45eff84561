// Skins (glTF 2.0, section 3.7.3): joint matrices of a placed node graph, and the vertices they
// move.
#pragma once

#include "scenes/load/gltf/accessor.h"
#include "scenes/load/gltf/nodes.h"

#include <vector>

namespace shadowproof::gltf {

/// One matrix per joint, to the world from the mesh's own space. The skinned node's own transform
/// is ignored.
struct Skin {
    std::vector<glm::dmat4> world_from_mesh;
    MemoryHold held{}; ///< for the matrices
};

/// Joints and weights by set (JOINTS_0, JOINTS_1, ...), each element four of them.
struct Influences {
    std::vector<Elements> joints;
    std::vector<Elements> weights;
    Place primitive; ///< for messages
};

Skin read_skin(AccessorReader& reader, const NodeGraph& graph, std::size_t skin);

/// Refused: no JOINTS_0 or WEIGHTS_0, counts that differ, a joint out of range, a negative weight.
Influences read_influences(AccessorReader& reader, const Place& place,
                           const tinygltf::Primitive& primitive, const Skin& skin,
                           std::size_t vertices);

/// World position of a vertex. Weights are divided by their sum, which exporters round; a sum of
/// zero is refused.
glm::dvec3 deform(const Skin& skin, const Influences& influences, std::size_t vertex,
                  const glm::dvec4& point);

/// The linear part of deform at a vertex: directions in the world from the mesh's own space.
glm::dmat3 deformation(const Skin& skin, const Influences& influences, std::size_t vertex);

} // namespace shadowproof::gltf
