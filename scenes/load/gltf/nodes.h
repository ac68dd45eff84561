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
    glm::dmat4 world_from_node{1.0}; ///< set by place_nodes
};

struct NodeGraph {
    std::vector<Node> nodes;
    std::vector<std::size_t> order;    ///< every node, parents before children
    std::vector<std::size_t> in_scene; ///< those of the chosen scene, depth first, as listed
};

/// The scene is the file's default, else its first; a file without scenes shows every root.
NodeGraph read_nodes(const Document& document);

/// Multiplies local transforms down the forest. Throws Error where a matrix is no longer finite.
void place_nodes(NodeGraph& graph);

} // namespace shadowproof::gltf
