#include "scenes/load/gltf/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace shadowproof::gltf {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

glm::dmat4 read_matrix(const Place& place, const std::vector<double>& values) {
    const glm::dmat4 matrix = glm::make_mat4(values.data());
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
        place.refuse("has a last row that is not 0 0 0 1", "write an affine matrix");
    return matrix;
}

/// extras.shadowproof's boolean of that name.
std::optional<bool> read_flag(const tinygltf::Node& source, const char* name) {
    const char* const ours = "shadowproof";
    if (!source.extras.Has(ours) || !source.extras.Get(ours).Has(name)) return std::nullopt;
    return source.extras.Get(ours).Get(name).Get<bool>();
}

/// Whether KHR_node_visibility leaves it visible by itself.
bool read_visibility(const tinygltf::Node& source) {
    const auto found = source.extensions.find("KHR_node_visibility");
    return found == source.extensions.end() || !found->second.Has("visible") ||
           found->second.Get("visible").Get<bool>();
}

/// In tinygltf what the file does not give is empty.
Node read_node(const Place& place, const tinygltf::Node& source) {
    Node node{.name = source.name, .place = place};
    if (!source.matrix.empty()) node.matrix = read_matrix(place / "matrix", source.matrix);
    if (!source.translation.empty()) node.translation = glm::make_vec3(source.translation.data());
    if (!source.rotation.empty())
        node.rotation = unit_rotation(place / "rotation", source.rotation);
    if (!source.scale.empty()) node.scale = glm::make_vec3(source.scale.data());
    node.weights = source.weights;
    node.casts = read_flag(source, "casts");
    node.receives = read_flag(source, "receives");
    node.visible = read_visibility(source);
    for (const int child : source.children) node.children.push_back(as_index(child));
    return node;
}

/// Each node's parent, or none. Refuses a second parent.
std::vector<std::size_t> find_parents(const NodeGraph& graph) {
    std::vector<std::size_t> parents(graph.nodes.size(), none);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const std::vector<std::size_t>& children = graph.nodes[i].children;
        for (std::size_t k = 0; k < children.size(); ++k) {
            if (parents[children[k]] != none)
                (graph.nodes[i].place / "children" / k)
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

/// Every node below a root. Since each has at most one parent, the rest are on a cycle or descend
/// from one.
std::vector<std::size_t> order_nodes(const NodeGraph& graph,
                                     const std::vector<std::size_t>& parents) {
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (parents[i] == none) roots.push_back(i);
    std::vector<std::size_t> order = descend(graph, roots);
    if (order.size() == parents.size()) return order;
    std::vector<bool> reached(parents.size(), false);
    for (const std::size_t node : order) reached[node] = true;
    const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
    graph.nodes[static_cast<std::size_t>(lost)].place.refuse(
        "is below itself: its ancestors form a cycle", "break the cycle");
}

/// A node without these flags takes them from its nearest ancestor that has them; one below a
/// hidden node is hidden.
void pass_flags_on(NodeGraph& graph) {
    for (const std::size_t parent : graph.order) {
        Node& node = graph.nodes[parent];
        for (const std::size_t child : node.children)
            graph.nodes[child].visible = graph.nodes[child].visible && node.visible;
        for (std::optional<bool> Node::*flag : {&Node::casts, &Node::receives}) {
            node.*flag = (node.*flag).value_or(true);
            for (const std::size_t child : node.children) {
                std::optional<bool>& own = graph.nodes[child].*flag;
                own = own.value_or(*(node.*flag));
            }
        }
    }
}

/// One flag per node: some node above it is listed.
std::vector<bool> nodes_below(const NodeGraph& graph, const std::vector<bool>& listed) {
    std::vector<bool> below(listed.size(), false);
    for (const std::size_t node : graph.order)
        for (const std::size_t child : graph.nodes[node].children)
            below[child] = below[node] || listed[node];
    return below;
}

/// What the chosen scene lists, but what is below other nodes of the list; without scenes, all
/// nodes that have no parent.
std::vector<std::size_t> scene_roots(const Document& document, const NodeGraph& graph,
                                     const std::vector<std::size_t>& parents,
                                     std::vector<std::string>& notes) {
    std::vector<std::size_t> roots;
    if (document.model.scenes.empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] == none) roots.push_back(i);
        return roots;
    }
    const std::size_t scene = as_index(std::max(document.model.defaultScene, 0));
    const Place place = document.root() / "scenes" / scene / "nodes";
    std::vector<bool> listed(parents.size(), false);
    for (const int listed_node : document.model.scenes[scene].nodes) {
        const std::size_t node = as_index(listed_node);
        if (listed[node])
            (place / roots.size()).refuse(fmt::format("names node {} again", node), "list it once");
        listed[node] = true;
        roots.push_back(node);
    }
    const auto children = std::count_if(roots.begin(), roots.end(),
                                        [&](std::size_t node) { return parents[node] != none; });
    if (children > 0)
        notes.push_back(fmt::format("{}: {} of its nodes are children of others, and stand where "
                                    "those place them; glTF allows roots only",
                                    place.pointer(), children));
    const std::vector<bool> below = nodes_below(graph, listed);
    std::erase_if(roots, [&](std::size_t node) { return below[node]; });
    return roots;
}

void note_hidden(const NodeGraph& graph, std::vector<std::string>& notes) {
    const auto hidden = std::count_if(graph.in_scene.begin(), graph.in_scene.end(),
                                      [&](std::size_t node) { return !graph.nodes[node].visible; });
    if (hidden > 0)
        notes.push_back(
            fmt::format("nodes that KHR_node_visibility hides are left out: {}", hidden));
}

bool is_finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

} // namespace

glm::dquat unit_rotation(const Place& place, const std::vector<double>& q) {
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length))
        place.refuse("has no direction", "write a unit quaternion");
    return {q[3] / length, q[0] / length, q[1] / length, q[2] / length};
}

glm::dmat4 local_transform(const Node& node) {
    if (node.matrix) return *node.matrix;
    glm::dmat4 matrix = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[axis];
    matrix[3] = glm::dvec4(node.translation, 1);
    return matrix;
}

NodeGraph read_nodes(const Document& document, std::vector<std::string>& notes) {
    NodeGraph graph;
    for (const tinygltf::Node& node : document.model.nodes)
        graph.nodes.push_back(read_node(document.root() / "nodes" / graph.nodes.size(), node));
    const std::vector<std::size_t> parents = find_parents(graph);
    graph.order = order_nodes(graph, parents);
    pass_flags_on(graph);
    graph.in_scene = descend(graph, scene_roots(document, graph, parents, notes));
    note_hidden(graph, notes);
    return graph;
}

void place_nodes(NodeGraph& graph) {
    for (Node& node : graph.nodes) node.world_from_node = local_transform(node);
    for (const std::size_t parent : graph.order) {
        const Node& node = graph.nodes[parent];
        if (!is_finite(node.world_from_node))
            node.place.refuse("has a world transform that is not finite",
                              "scale the transforms of it and its ancestors down");
        for (const std::size_t child : node.children)
            graph.nodes[child].world_from_node =
                node.world_from_node * graph.nodes[child].world_from_node;
    }
}

} // namespace shadowproof::gltf
