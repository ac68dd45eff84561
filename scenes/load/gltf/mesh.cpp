#include "scenes/load/gltf/mesh.h"

#include "scenes/load/gltf/attribute.h"
#include "scenes/load/gltf/instances.h"
#include "scenes/load/gltf/material.h"
#include "scenes/load/gltf/surface.h"

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
    triangles.reserve(mode == Mode::triangles ? n / 3 : n);
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

const Attribute position{"POSITION", TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, floats,
                         normalized_integers | plain_integers};

/// What the primitives of one node share.
struct Placement {
    const Node& node;
    const tinygltf::Mesh& mesh;
    Place place; ///< of the mesh
    std::string name;
    std::vector<double> weights;
    std::optional<Skin> skin;
    glm::dmat4 world_from_mesh{1.0}; ///< unless there is a skin
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
                        std::nullopt,
                        node.world_from_node};
    if (placement.name.empty()) placement.name = mesh.name;
    if (placement.name.empty()) placement.name = node.place.pointer();
    if (source.skin >= 0) placement.skin = read_skin(reader, graph, as_index(source.skin));
    return placement;
}

/// World positions of a primitive's vertices, rounded to float.
std::vector<glm::vec3> world_positions(const Placement& placement, const Part& part,
                                       const Elements& local,
                                       const std::optional<Influences>& influences) {
    std::vector<glm::vec3> world(local.count);
    for (std::size_t i = 0; i < local.count; ++i) {
        const glm::dvec4 point(local.vec3(i), 1);
        const glm::dvec3 placed = influences ? deform(*placement.skin, *influences, i, point)
                                             : glm::dvec3(placement.world_from_mesh * point);
        world[i] = glm::vec3(placed);
        if (!std::isfinite(world[i].x) || !std::isfinite(world[i].y) || !std::isfinite(world[i].z))
            (part.place / "attributes" / position.name)
                .refuse(fmt::format("vertex {} is not finite in world space as placed by {}", i,
                                    placement.node.place.pointer()),
                        "scale the vertex or the node's transform down");
    }
    return world;
}

/// Bytes per vertex of a primitive while it is baked: world positions, normals, coordinates in a
/// mask, their order, which of them are used. And per triangle: indices, one triangle for each
/// where it is a strip.
constexpr std::uint64_t baking_vertex =
    2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 2 * sizeof(std::uint32_t);
constexpr std::uint64_t baking_index = sizeof(std::uint32_t) + sizeof(glm::uvec3);
/// Bytes kept in the scene per vertex or triangle, three times as much while its vector grows.
constexpr std::uint64_t baked_vertex = 3 * (2 * sizeof(glm::vec3) + sizeof(glm::vec2));
/// Bytes per mesh without its name, and for a note about it.
constexpr std::uint64_t baked_mesh = 3 * sizeof(Mesh) + 256;

/// A primitive's vertices, in world space.
struct Vertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> mask_at; ///< in an alpha mask; empty where there is none
    std::optional<std::vector<glm::vec3>>
        normals; ///< where they are wanted; empty: none in the file
};

/// Appends `triangles` with the vertices that are used, in order of index.
void append(Scene& scene, MemoryAccount& memory, const Place& primitive, const Vertices& vertices,
            const std::vector<glm::uvec3>& triangles) {
    const auto& [positions, mask_at, normals] = vertices;
    std::vector<std::uint32_t> baked(positions.size(), 0);
    for (const glm::uvec3& triangle : triangles)
        for (int k = 0; k < 3; ++k) baked[triangle[k]] = 1;
    const auto used =
        static_cast<std::uint64_t>(std::count(baked.begin(), baked.end(), std::uint32_t{1}));
    if (scene.triangles.size() + triangles.size() > limits.triangles ||
        scene.positions.size() + used > limits.triangles)
        primitive.refuse(
            fmt::format("brings the scene above {} triangles or vertices", limits.triangles),
            "split the asset");
    memory.keep({baked_vertex * (used + triangles.size()), primitive.where(), "its triangles",
                 "split the asset"});
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (baked[i] == 0) continue;
        baked[i] = static_cast<std::uint32_t>(scene.positions.size());
        scene.positions.push_back(positions[i]);
        if (has_masks(scene))
            scene.mask_at.push_back(mask_at.empty() ? glm::vec2(0, 0) : mask_at[i]);
        if (normals) scene.normals.push_back(normals->empty() ? glm::vec3(0) : (*normals)[i]);
    }
    for (const glm::uvec3& triangle : triangles)
        scene.triangles.emplace_back(baked[triangle.x], baked[triangle.y], baked[triangle.z]);
}

bool is_mirrored(const Placement& placement) {
    return !placement.skin && glm::determinant(glm::dmat3(placement.world_from_mesh)) < 0;
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

MemoryHold hold_for_baking(AccessorReader& reader, const Part& part, std::size_t vertices) {
    const std::uint64_t indices =
        part.primitive.indices >= 0
            ? reader.document().model.accessors[as_index(part.primitive.indices)].count
            : vertices;
    return reader.memory().hold({baking_vertex * vertices + baking_index * indices,
                                 part.place.where(), "its vertices", "split the primitive"});
}

void note_vertex_alpha(const Document& document, const Part& part, std::uint32_t material,
                       Scene& scene) {
    const auto& all = document.model.materials;
    if (material < all.size() && all[material].alphaMode == "MASK" &&
        part.primitive.attributes.count("COLOR_0") != 0)
        scene.notes.push_back(part.place.pointer() +
                              "/attributes/COLOR_0: its alpha is not evaluated");
}

/// Whether a renderer that evaluates the material has colours that vary over the primitive.
bool is_textured(const Document& document, const Part& part) {
    if (part.primitive.attributes.count("COLOR_0") != 0) return true;
    if (part.primitive.material < 0) return false;
    const tinygltf::Material& material =
        document.model.materials[as_index(part.primitive.material)];
    return material.pbrMetallicRoughness.baseColorTexture.index >= 0 ||
           material.emissiveTexture.index >= 0 ||
           material.extensions.contains("KHR_materials_pbrSpecularGlossiness");
}

void bake_primitive(AccessorReader& reader, const Placement& placement, const Part& part,
                    const Materials& materials, bool normals, Scene& scene) {
    // Each mesh costs time however small it is: it may be placed in the scene many times.
    reader.charge(part.place, 1 + placement.weights.size());
    reader.memory().keep({baked_mesh + placement.name.size(), part.place.where(), "its name",
                          "merge meshes, or shorten their names"});
    const auto mode = static_cast<Mode>(part.primitive.mode);
    if (mode < Mode::triangles) {
        scene.notes.push_back(part.place.pointer() + ": points and lines are left out");
        return;
    }
    if (!has_attribute(part, position)) {
        scene.notes.push_back(part.place.pointer() + ": left out, it has no positions");
        return;
    }
    const Elements local = read_morphed(reader, part, position, placement.weights);
    std::optional<Influences> influences;
    if (placement.skin)
        influences =
            read_influences(reader, part.place, part.primitive, *placement.skin, local.count);
    const auto material =
        static_cast<std::uint32_t>(part.primitive.material >= 0 ? as_index(part.primitive.material)
                                                                : scene.materials.size() - 1);
    note_vertex_alpha(reader.document(), part, material, scene);
    if (materials.left_out[material]) return;
    Vertices vertices;
    if (scene.materials[material].mask != no_mask)
        vertices.mask_at = texture_coordinates(reader, part, placement.weights, local.count,
                                               materials.sets[material].mask, "an alpha mask");
    const MemoryHold baking = hold_for_baking(reader, part, local.count);
    vertices.positions = world_positions(placement, part, local, influences);
    const std::vector<std::uint32_t> indices = vertex_order(reader, part, local.count);
    std::vector<glm::uvec3> triangles = assemble(mode, indices);
    note_leftover(scene, part.place, indices.size(), triangles.size(), mode);
    const bool mirrored = is_mirrored(placement);
    const PosedPart posed{
        part,           placement.weights, local,   triangles, placement.world_from_mesh,
        placement.skin, influences,        mirrored};
    if (materials.bump_lit)
        append_surfaces(reader, posed, scene.materials[material], materials.sets[material], scene);
    if (normals) vertices.normals = world_normals(reader, posed);
    if (mirrored)
        for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    const auto count = static_cast<std::uint32_t>(triangles.size());
    append(scene, reader.memory(), part.place, vertices, triangles);
    if (count > 0)
        scene.meshes.push_back(
            {placement.name, first, count, material, placement.node.casts.value_or(true),
             placement.node.receives.value_or(true), is_textured(reader.document(), part)});
}

} // namespace

void bake_meshes(AccessorReader& reader, const NodeGraph& graph, bool normals, Scene& scene) {
    const Materials materials = read_materials(reader.document(), graph, scene);
    for (const std::size_t node : graph.in_scene) {
        if (!has_visible_mesh(reader.document(), graph, node)) continue;
        Placement placement = find_placement(reader, graph, node);
        const std::string name = placement.name;
        const std::vector<glm::dmat4> instances = read_instances(reader, node);
        for (std::size_t instance = 0; instance < instances.size(); ++instance) {
            placement.world_from_mesh = placement.node.world_from_node * instances[instance];
            if (instances.size() > 1) placement.name = fmt::format("{} [{}]", name, instance);
            for (std::size_t i = 0; i < placement.mesh.primitives.size(); ++i)
                bake_primitive(reader, placement,
                               {placement.place / "primitives" / i, placement.mesh.primitives[i]},
                               materials, normals, scene);
        }
    }
    const bool some_left_out =
        std::ranges::find(materials.left_out, true) != materials.left_out.end();
    if (scene.triangles.empty() && some_left_out)
        reader.document().root().refuse("has alpha masks that leave none of its triangles",
                                        "lower alphaCutoff, or choose the alphaMode OPAQUE");
    if (scene.triangles.empty())
        reader.document().root().refuse("holds no triangle in its scene",
                                        "export meshes, or set \"scene\" to one that has some");
}

} // namespace shadowproof::gltf
