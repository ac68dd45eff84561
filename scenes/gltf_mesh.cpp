#include "scenes/gltf_mesh.h"

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
    const std::vector<std::string>& used = document.model.extensionsUsed;
    const bool quantized =
        std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
    return quantized ? floats | normalized_integers | plain_integers : unsigned{floats};
}

/// A primitive and where it stands.
struct Part {
    Place place;
    const tinygltf::Primitive& primitive;
};

Elements read_positions(AccessorReader& reader, const Place& reference, int accessor) {
    return reader.read(reference, accessor, TINYGLTF_TYPE_VEC3, position_kinds(reader.document()));
}

/// Adds weight times displacement for every morph target (section 3.7.2.2).
void apply_morphs(AccessorReader& reader, const Part& part, const std::vector<double>& weights,
                  Elements& positions) {
    const auto& targets = part.primitive.targets;
    if (!weights.empty() && weights.size() != targets.size())
        part.place.refuse(
            fmt::format("has {} morph targets for {} weights", targets.size(), weights.size()),
            "give each target one weight");
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto attribute = targets[i].find("POSITION");
        if (attribute == targets[i].end() || weights[i] == 0) continue;
        const Place reference = part.place / "targets" / i / "POSITION";
        const Elements offsets = read_positions(reader, reference, attribute->second);
        if (offsets.count != positions.count)
            reference.refuse(
                fmt::format("has {} elements for {} vertices", offsets.count, positions.count),
                "give each vertex one displacement");
        for (std::size_t k = 0; k < positions.values.size(); ++k)
            positions.values[k] += weights[i] * offsets.values[k];
    }
}

/// What the primitives of one node share.
struct Placement {
    const Node& node;
    const tinygltf::Mesh& mesh;
    Place place; ///< of the mesh
    std::string name;
    std::vector<double> weights;
    std::optional<Skin> skin;
};

Placement find_placement(AccessorReader& reader, const NodeGraph& graph, std::size_t index) {
    const Document& document = reader.document();
    const tinygltf::Node& source = document.model.nodes[index];
    const Node& node = graph.nodes[index];
    const std::size_t mesh_index = as_index(source.mesh);
    const tinygltf::Mesh& mesh = document.model.meshes[mesh_index];
    Placement placement{node,
                        mesh,
                        document.root() / "meshes" / mesh_index,
                        node.name,
                        node.weights.empty() ? mesh.weights : node.weights,
                        std::nullopt};
    if (placement.name.empty()) placement.name = mesh.name;
    if (placement.name.empty()) placement.name = node.place.pointer();
    if (source.skin >= 0) placement.skin = read_skin(reader, graph, as_index(source.skin));
    return placement;
}

/// World positions of a primitive's vertices, rounded to float.
std::vector<glm::vec3> world_positions(AccessorReader& reader, const Placement& placement,
                                       const Part& part, int accessor) {
    const Place reference = part.place / "attributes" / "POSITION";
    Elements local = read_positions(reader, reference, accessor);
    apply_morphs(reader, part, placement.weights, local);
    std::optional<Influences> influences;
    if (placement.skin)
        influences =
            read_influences(reader, part.place, part.primitive, *placement.skin, local.count);
    std::vector<glm::vec3> world(local.count);
    for (std::size_t i = 0; i < local.count; ++i) {
        const glm::dvec4 point(local.vec3(i), 1);
        const glm::dvec3 placed = influences ? deform(*placement.skin, *influences, i, point)
                                             : glm::dvec3(placement.node.world_from_node * point);
        world[i] = glm::vec3(placed);
        if (!std::isfinite(world[i].x) || !std::isfinite(world[i].y) || !std::isfinite(world[i].z))
            reference.refuse(fmt::format("vertex {} is not finite in world space as placed by {}",
                                         i, placement.node.place.pointer()),
                             "scale the vertex or the node's transform down");
    }
    return world;
}

/// Appends `triangles` over `positions` with the vertices that are used, in order of index.
void append(Scene& scene, const Place& primitive, const std::vector<glm::vec3>& positions,
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

void note_leftover(Scene& scene, const Place& primitive, std::size_t vertices,
                   std::size_t triangles, Mode mode) {
    if (mode == Mode::triangles && vertices != 3 * triangles)
        scene.notes.push_back(fmt::format("{}: {} vertices at the end make no triangle",
                                          primitive.pointer(), vertices - 3 * triangles));
}

std::vector<std::uint32_t> vertex_order(AccessorReader& reader, const Part& part,
                                        std::size_t vertices) {
    if (part.primitive.indices >= 0)
        return reader.read_indices(part.place / "indices", part.primitive.indices, vertices);
    std::vector<std::uint32_t> order(vertices);
    std::iota(order.begin(), order.end(), 0U);
    return order;
}

void bake_primitive(AccessorReader& reader, const Placement& placement, const Part& part,
                    Scene& scene) {
    const auto mode = static_cast<Mode>(part.primitive.mode);
    if (mode < Mode::triangles) {
        scene.notes.push_back(part.place.pointer() + ": points and lines are left out");
        return;
    }
    const auto attribute = part.primitive.attributes.find("POSITION");
    if (attribute == part.primitive.attributes.end()) {
        scene.notes.push_back(part.place.pointer() + ": left out, it has no positions");
        return;
    }
    const std::vector<glm::vec3> positions =
        world_positions(reader, placement, part, attribute->second);
    const std::vector<std::uint32_t> indices = vertex_order(reader, part, positions.size());
    std::vector<glm::uvec3> triangles = assemble(mode, indices);
    note_leftover(scene, part.place, indices.size(), triangles.size(), mode);
    if (is_mirrored(placement))
        for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
    const auto material =
        static_cast<std::uint32_t>(part.primitive.material >= 0 ? as_index(part.primitive.material)
                                                                : scene.materials.size() - 1);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    const auto count = static_cast<std::uint32_t>(triangles.size());
    append(scene, part.place, positions, std::move(triangles));
    if (count > 0)
        scene.meshes.push_back({placement.name, first, count, material,
                                placement.node.casts.value_or(true),
                                placement.node.receives.value_or(true)});
}

/// The file's materials, and behind them the default one (section 3.7.2.1).
void read_materials(const Document& document, Scene& scene) {
    for (const tinygltf::Material& source : document.model.materials) {
        const Place place = document.root() / "materials" / scene.materials.size();
        const std::string name = source.name.empty() ? place.pointer() : source.name;
        scene.materials.push_back({name, source.doubleSided});
        if (source.alphaMode != "OPAQUE")
            scene.notes.push_back(fmt::format("{} \"{}\": alphaMode {} is drawn as opaque",
                                              place.pointer(), name, source.alphaMode));
        if (source.normalTexture.index >= 0)
            scene.notes.push_back(
                fmt::format("{}: normal maps are not evaluated: visibility only", place.pointer()));
    }
    scene.materials.push_back({"default", false});
}

} // namespace

void bake_meshes(AccessorReader& reader, const NodeGraph& graph, Scene& scene) {
    read_materials(reader.document(), scene);
    for (const std::size_t node : graph.in_scene) {
        if (reader.document().model.nodes[node].mesh < 0) continue;
        const Placement placement = find_placement(reader, graph, node);
        for (std::size_t i = 0; i < placement.mesh.primitives.size(); ++i)
            bake_primitive(reader, placement,
                           {placement.place / "primitives" / i, placement.mesh.primitives[i]},
                           scene);
    }
    if (scene.triangles.empty())
        reader.document().root().refuse("holds no triangle in its scene",
                                        "export meshes, or set \"scene\" to one that has some");
}

} // namespace shadowproof::gltf
