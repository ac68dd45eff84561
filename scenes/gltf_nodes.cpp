#include "scenes/gltf_nodes.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowproof::gltf {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

glm::dmat4 read_matrix(const Item& item) {
    const std::vector<double> values = item.numbers(16);
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            matrix[column][row] = values[static_cast<std::size_t>(column * 4 + row)];
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
        item.refuse("has a last row that is not 0 0 0 1", "write an affine matrix");
    return matrix;
}

/// glTF asks for a unit quaternion (x, y, z, w); exporters round it, so its length is made 1.
glm::dquat read_rotation(const Item& item) {
    const std::vector<double> q = item.numbers(4);
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length))
        item.refuse("has no direction", "write a unit quaternion");
    return {q[3] / length, q[0] / length, q[1] / length, q[2] / length};
}

Node read_node(const Item& root, const Item& item) {
    Node node;
    node.name = item.text_or("name", "");
    node.pointer = item.pointer();
    if (const auto matrix = item.find("matrix")) {
        for (const char* key : {"translation", "rotation", "scale"})
            if (item.has(key))
                item.refuse(fmt::format("has both \"matrix\" and \"{}\"", key), "keep one");
        node.matrix = read_matrix(*matrix);
    }
    if (const auto translation = item.find("translation")) node.translation = translation->vector();
    if (const auto rotation = item.find("rotation")) node.rotation = read_rotation(*rotation);
    if (const auto scale = item.find("scale")) node.scale = scale->vector();
    if (const auto weights = item.find("weights")) node.weights = weights->numbers(weights->size());
    if (const auto children = item.find("children"))
        for (std::size_t i = 0; i < children->size(); ++i)
            node.children.push_back(reference_index(root, "nodes", (*children)[i]));
    return node;
}

/// Each node's parent, or none. Refuses a second parent.
std::vector<std::size_t> find_parents(const Document& document, const NodeGraph& graph) {
    std::vector<std::size_t> parents(graph.nodes.size(), none);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const std::vector<std::size_t>& children = graph.nodes[i].children;
        for (std::size_t k = 0; k < children.size(); ++k) {
            if (parents[children[k]] != none)
                node_item(document, i)
                    .at("children")[k]
                    .refuse(fmt::format("makes node {} a child for the second time", children[k]),
                            "give each node one parent");
            parents[children[k]] = i;
        }
    }
    return parents;
}

/// `roots` and all below them, depth first.
std::vector<std::size_t> descend(const NodeGraph& graph, std::vector<std::size_t> roots) {
    std::vector<std::size_t> order;
    std::reverse(roots.begin(), roots.end());
    for (std::vector<std::size_t>& waiting = roots; !waiting.empty();) {
        const std::size_t node = waiting.back();
        waiting.pop_back();
        order.push_back(node);
        const std::vector<std::size_t>& children = graph.nodes[node].children;
        waiting.insert(waiting.end(), children.rbegin(), children.rend());
    }
    return order;
}

/// Every node below a root. With one parent each at most, whatever is not is on a cycle or hangs
/// from one.
std::vector<std::size_t> order_nodes(const Document& document, const NodeGraph& graph,
                                     const std::vector<std::size_t>& parents) {
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (parents[i] == none) roots.push_back(i);
    std::vector<std::size_t> order = descend(graph, roots);
    if (order.size() == parents.size()) return order;
    std::vector<bool> reached(parents.size(), false);
    for (const std::size_t node : order) reached[node] = true;
    const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
    node_item(document, static_cast<std::size_t>(lost))
        .refuse("is below itself: its ancestors form a cycle", "break the cycle");
}

std::vector<std::size_t> scene_roots(const Item& root, const std::vector<std::size_t>& parents) {
    std::vector<std::size_t> roots;
    if (count_of(root, "scenes") == 0) {
        if (const auto scene = root.find("scene"))
            scene->refuse("names a scene but there is none", "add the scene");
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] == none) roots.push_back(i);
        return roots;
    }
    const auto chosen = root.find("scene");
    const Item scene = chosen ? referenced(root, "scenes", *chosen) : root.at("scenes")[0];
    const auto nodes = scene.find("nodes");
    std::vector<bool> listed(parents.size(), false);
    for (std::size_t i = 0; nodes && i < nodes->size(); ++i) {
        const Item reference = (*nodes)[i];
        const std::size_t node = reference_index(root, "nodes", reference);
        if (parents[node] != none)
            reference.refuse(
                fmt::format("names node {}, which is a child of node {}", node, parents[node]),
                "list root nodes only");
        if (listed[node])
            reference.refuse(fmt::format("names node {} again", node), "list it once");
        listed[node] = true;
        roots.push_back(node);
    }
    return roots;
}

bool is_finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

glm::dmat4 local_transform(const Node& node) {
    if (node.matrix) return *node.matrix;
    glm::dmat4 matrix = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[axis];
    matrix[3] = glm::dvec4(node.translation, 1);
    return matrix;
}

} // namespace

NodeGraph read_nodes(const Document& document) {
    const Item root = document.root();
    NodeGraph graph;
    const std::size_t count = count_of(root, "nodes");
    for (std::size_t i = 0; i < count; ++i)
        graph.nodes.push_back(read_node(root, node_item(document, i)));
    const std::vector<std::size_t> parents = find_parents(document, graph);
    graph.order = order_nodes(document, graph, parents);
    graph.in_scene = descend(graph, scene_roots(root, parents));
    return graph;
}

void place_nodes(const Document& document, NodeGraph& graph) {
    for (Node& node : graph.nodes) node.world_from_node = local_transform(node);
    for (const std::size_t parent : graph.order) {
        if (!is_finite(graph.nodes[parent].world_from_node))
            node_item(document, parent)
                .refuse("has a world transform that is not finite",
                        "scale the transforms of it and its ancestors down");
        for (const std::size_t child : graph.nodes[parent].children)
            graph.nodes[child].world_from_node =
                graph.nodes[parent].world_from_node * graph.nodes[child].world_from_node;
    }
}

} // namespace shadowproof::gltf
