// The node graph: a forest whose local transforms become world transforms in double precision.
// Cycles and second parents are refused.
#pragma once

#include "scenes/load/gltf/file.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof::gltf {

struct Node {
    std::string name; ///< may be empty
    Place place;
    std::vector<std::size_t> children{};
    std::optional<glm::dmat4> matrix{}; ///< in place of translation, rotation, scale
    glm::dvec3 translation{0, 0, 0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 scale{1, 1, 1};
    std::vector<double> weights{};   ///< of morph targets; empty: the mesh's own
    std::optional<bool> casts{};     ///< extras.shadowproof.casts; passed on to the children, and
    std::optional<bool> receives{};  ///< there for every node, by read_nodes
    bool visible = true;             ///< KHR_node_visibility; hidden where an ancestor is
    glm::dmat4 world_from_node{1.0}; ///< set by place_nodes
};

struct NodeGraph {
    std::vector<Node> nodes;
    std::vector<std::size_t> order;    ///< every node, parents before children
    std::vector<std::size_t> in_scene; ///< those of the chosen scene, depth first, as listed
};

/// A unit quaternion of x, y, z, w. Exporters round them, so it is normalised; refused at `place`
/// where that is not possible.
glm::dquat unit_rotation(const Place& place, const std::vector<double>& q);

/// From the node's space to its parent's.
glm::dmat4 local_transform(const Node& node);

/// The scene is the file's default, else its first; a file without scenes shows every root. A scene
/// that lists children (glTF allows roots only) shows them where their parents place them, once;
/// `notes` says so, and of hidden nodes.
NodeGraph read_nodes(const Document& document, std::vector<std::string>& notes);

/// Whether the node shows a mesh.
inline bool has_visible_mesh(const Document& document, const NodeGraph& graph, std::size_t node) {
    return document.model.nodes[node].mesh >= 0 && graph.nodes[node].visible;
}

/// Multiplies local transforms down the forest. Throws Error where a matrix is no longer finite.
void place_nodes(NodeGraph& graph);

} // namespace shadowproof::gltf
