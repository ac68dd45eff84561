// Skins (glTF 2.0, section 3.7.3): joint matrices of a placed node graph, and the vertices they
// move.
#pragma once

#include "scenes/gltf_accessor.h"
#include "scenes/gltf_nodes.h"

#include <vector>

namespace shadowproof::gltf {

/// For each joint: world from the mesh's own space. The skinned node's own transform has no part
/// in it.
struct Skin {
    std::vector<glm::dmat4> world_from_mesh;
    MemoryHold held{}; ///< for them
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

/// What deform does to directions at a vertex: world from the mesh's own space.
glm::dmat3 deformation(const Skin& skin, const Influences& influences, std::size_t vertex);

} // namespace shadowproof::gltf
