#include "scenes/gltf_mesh.h"

#include "scenes/error.h"
#include "scenes/gltf_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numeric>

namespace shadowproof::gltf {

namespace {

enum class Mode : std::uint8_t { points, lines, line_loop, line_strip, triangles, strip, fan };

/// Triangles of a list, strip or fan over `indices` (glTF 2.0, section 3.7.2.1).
std::vector<glm::uvec3> assemble(Mode mode, const std::vector<std::uint32_t>& indices) {
    std::vector<glm::uvec3> triangles;
    const std::size_t n = indices.size();
    if (mode == Mode::triangles)
        for (std::size_t i = 0; i + 2 < n; i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    if (mode == Mode::strip)
        for (std::size_t i = 0; i + 2 < n; ++i)
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
    if (mode == Mode::fan)
        for (std::size_t i = 1; i + 1 < n; ++i)
            triangles.emplace_back(indices[i], indices[i + 1], indices[0]);
    return triangles;
}

unsigned position_kinds(const Document& document) {
    const auto used = document.root().find("extensionsUsed");
    for (std::size_t i = 0; used && i < used->size(); ++i)
        if ((*used)[i].text() == "KHR_mesh_quantization")
            return floats | normalized_integers | plain_integers;
    return floats;
}

/// Adds weight times displacement for every morph target (section 3.7.2.2).
void apply_morphs(AccessorReader& reader, const Item& primitive, const std::vector<double>& weights,
                  Elements& positions) {
    const auto targets = primitive.find("targets");
    const std::size_t count = targets ? targets->size() : 0;
    if (!weights.empty() && weights.size() != count)
        primitive.refuse(fmt::format("has {} morph targets for {} weights", count, weights.size()),
                         "give each target one weight");
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto reference = (*targets)[i].find("POSITION");
        if (!reference || weights[i] == 0) continue;
        const Elements offsets =
            reader.read(*reference, {"VEC3"}, position_kinds(reader.document()));
        if (offsets.count != positions.count)
            reference->refuse(
                fmt::format("has {} elements for {} vertices", offsets.count, positions.count),
                "give each vertex one displacement");
        for (std::size_t k = 0; k < positions.values.size(); ++k)
            positions.values[k] += weights[i] * offsets.values[k];
    }
}

/// What the primitives of one node share.
struct Placement {
    const Node& node;
    Item mesh;
    std::string name;
    std::vector<double> weights;
    std::optional<Skin> skin;
};

Placement find_placement(AccessorReader& reader, const NodeGraph& graph, std::size_t index) {
    const Document& document = reader.document();
    const Node& node = graph.nodes[index];
    const Item item = node_item(document, index);
    const Item mesh = referenced(document.root(), "meshes", item.at("mesh"));
    Placement placement{node, mesh, node.name, node.weights, std::nullopt};
    if (placement.name.empty()) placement.name = mesh.text_or("name", "");
    if (placement.name.empty()) placement.name = node.pointer;
    if (const auto weights = mesh.find("weights"); weights && node.weights.empty())
        placement.weights = weights->numbers(weights->size());
    if (const auto skin = item.find("skin"))
        placement.skin = read_skin(reader, graph, referenced(document.root(), "skins", *skin));
    return placement;
}

/// World positions of a primitive's vertices, rounded to float.
std::vector<glm::vec3> world_positions(AccessorReader& reader, const Placement& placement,
                                       const Item& primitive, const Item& reference) {
    Elements local = reader.read(reference, {"VEC3"}, position_kinds(reader.document()));
    apply_morphs(reader, primitive, placement.weights, local);
    std::optional<Influences> influences;
    if (placement.skin)
        influences = read_influences(reader, primitive, *placement.skin, local.count);
    std::vector<glm::vec3> world(local.count);
    for (std::size_t i = 0; i < local.count; ++i) {
        const glm::dvec4 point(local.vec3(i), 1);
        const glm::dvec3 placed = influences ? deform(*placement.skin, *influences, i, point)
                                             : glm::dvec3(placement.node.world_from_node * point);
        world[i] = glm::vec3(placed);
        if (!std::isfinite(world[i].x) || !std::isfinite(world[i].y) || !std::isfinite(world[i].z))
            reference.refuse(fmt::format("vertex {} is not finite in world space as placed by {}",
                                         i, placement.node.pointer),
                             "scale the vertex or the node's transform down");
    }
    return world;
}

/// Appends `triangles` over `positions` with the vertices that are used, in order of index.
void append(Scene& scene, const Item& primitive, const std::vector<glm::vec3>& positions,
            std::vector<glm::uvec3> triangles) {
    std::vector<std::uint32_t> baked(positions.size(), 0);
    for (const glm::uvec3& triangle : triangles)
        for (int k = 0; k < 3; ++k) baked[triangle[k]] = 1;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (baked[i] == 0) continue;
        baked[i] = static_cast<std::uint32_t>(scene.positions.size());
        scene.positions.push_back(positions[i]);
    }
    if (scene.triangles.size() + triangles.size() > limits.triangles ||
        scene.positions.size() > limits.triangles)
        primitive.refuse(
            fmt::format("brings the scene above {} triangles or vertices", limits.triangles),
            "split the asset");
    for (const glm::uvec3& triangle : triangles)
        scene.triangles.emplace_back(baked[triangle.x], baked[triangle.y], baked[triangle.z]);
}

bool is_mirrored(const Placement& placement) {
    return !placement.skin && glm::determinant(glm::dmat3(placement.node.world_from_node)) < 0;
}

void note_leftover(Scene& scene, const Item& primitive, std::size_t vertices, std::size_t triangles,
                   Mode mode) {
    if (mode == Mode::triangles && vertices != 3 * triangles)
        scene.notes.push_back(fmt::format("{}: {} vertices at the end make no triangle",
                                          primitive.pointer(), vertices - 3 * triangles));
}

void bake_primitive(AccessorReader& reader, const Placement& placement, const Item& primitive,
                    Scene& scene) {
    const auto mode = static_cast<Mode>(primitive.whole_or("mode", 0, 6, 4));
    if (mode < Mode::triangles) {
        scene.notes.push_back(primitive.pointer() + ": points and lines are left out");
        return;
    }
    const auto reference = primitive.at("attributes").find("POSITION");
    if (!reference) {
        scene.notes.push_back(primitive.pointer() + ": left out, it has no positions");
        return;
    }
    const std::vector<glm::vec3> positions =
        world_positions(reader, placement, primitive, *reference);
    std::vector<std::uint32_t> indices(positions.size());
    std::iota(indices.begin(), indices.end(), 0U);
    if (const auto given = primitive.find("indices"))
        indices = reader.read_indices(*given, positions.size());
    std::vector<glm::uvec3> triangles = assemble(mode, indices);
    note_leftover(scene, primitive, indices.size(), triangles.size(), mode);
    if (is_mirrored(placement))
        for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
    const std::uint32_t material =
        primitive.has("material")
            ? static_cast<std::uint32_t>(
                  reference_index(reader.document().root(), "materials", primitive.at("material")))
            : static_cast<std::uint32_t>(scene.materials.size() - 1);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    const auto count = static_cast<std::uint32_t>(triangles.size());
    append(scene, primitive, positions, std::move(triangles));
    if (count > 0) scene.meshes.push_back({placement.name, first, count, material});
}

/// The file's materials, and behind them the default one (section 3.7.2.1).
void read_materials(const Document& document, Scene& scene) {
    const Item root = document.root();
    const std::size_t count = count_of(root, "materials");
    for (std::size_t i = 0; i < count; ++i) {
        const Item item = root.at("materials")[i];
        const auto double_sided = item.find("doubleSided");
        scene.materials.push_back(
            {item.text_or("name", item.pointer()), double_sided && double_sided->truth()});
        if (const std::string mode = item.text_or("alphaMode", "OPAQUE"); mode != "OPAQUE")
            scene.notes.push_back(fmt::format("{} \"{}\": alphaMode {} is drawn as opaque",
                                              item.pointer(), scene.materials.back().name, mode));
        if (item.has("normalTexture"))
            scene.notes.push_back(
                fmt::format("{}: normal maps are not evaluated: visibility only", item.pointer()));
    }
    scene.materials.push_back({"default", false});
}

} // namespace

void bake_meshes(AccessorReader& reader, const NodeGraph& graph, Scene& scene) {
    read_materials(reader.document(), scene);
    for (const std::size_t node : graph.in_scene) {
        if (!node_item(reader.document(), node).has("mesh")) continue;
        const Placement placement = find_placement(reader, graph, node);
        const Item primitives = placement.mesh.at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i)
            bake_primitive(reader, placement, primitives[i], scene);
    }
    if (scene.triangles.empty())
        throw Error(reader.document().file, "holds no triangle in its scene",
                    "export meshes, or set \"scene\" to one that has some");
}

} // namespace shadowproof::gltf
