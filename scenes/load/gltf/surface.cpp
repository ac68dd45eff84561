#include "scenes/load/gltf/surface.h"

#include "scenes/surface/tangents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace shadowproof::gltf {

namespace {

const Attribute normals{"NORMAL", TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, floats,
                        normalized_integers};
const Attribute tangents{"TANGENT", TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC3, floats,
                         normalized_integers};

Attribute coordinates(std::size_t set) {
    return {fmt::format("TEXCOORD_{}", set), TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC2,
            floats | normalized_integers, plain_integers};
}

/// Bytes per corner while normals and tangents are made: below, and what make_tangents holds.
constexpr std::uint64_t corner_bytes = sizeof(std::uint32_t) + 3 * sizeof(glm::dvec3) +
                                       sizeof(glm::vec4) + 2 * sizeof(glm::vec2) + tangent_bytes;

/// Attributes of every corner, in the mesh's space.
struct Local {
    std::vector<std::uint32_t> vertices;
    std::vector<glm::dvec3> normals; ///< unit, but where an asset's is not
    std::vector<glm::vec4> tangents; ///< empty: none are wanted
    std::vector<glm::vec2> decal_at; ///< empty: no decal
    std::vector<glm::vec2> bump_at;  ///< empty: no bump map
};

std::vector<std::uint32_t> vertices_of(const std::vector<glm::uvec3>& triangles) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles)
        for (int k = 0; k < 3; ++k) vertices.push_back(triangle[k]);
    return vertices;
}

/// v over its length; where it has none, `otherwise`.
glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

/// The normal of the triangle that a corner belongs to, by its vertices' order; without area: along
/// z.
glm::dvec3 flat_normal(const PosedPart& posed, const Local& local, std::size_t corner) {
    const std::size_t first = corner / 3 * 3;
    const glm::dvec3 a = posed.positions.vec3(local.vertices[first]);
    const glm::dvec3 b = posed.positions.vec3(local.vertices[first + 1]);
    const glm::dvec3 c = posed.positions.vec3(local.vertices[first + 2]);
    return unit_or(glm::cross(b - a, c - a), {0, 0, 1});
}

void read_normals(AccessorReader& reader, const PosedPart& posed, Local& local) {
    std::optional<Elements> given;
    if (has_attribute(posed.part, normals))
        given = read_morphed(reader, posed.part, normals, posed.weights, posed.positions.count);
    local.normals.reserve(local.vertices.size());
    for (std::size_t i = 0; i < local.vertices.size(); ++i) {
        const glm::dvec3 flat = flat_normal(posed, local, i);
        local.normals.push_back(given ? unit_or(given->vec3(local.vertices[i]), flat) : flat);
    }
}

std::vector<glm::vec2> read_coordinates(AccessorReader& reader, const PosedPart& posed,
                                        const Local& local, const Coordinates& from,
                                        const char* what) {
    const std::vector<glm::vec2> of_vertices =
        texture_coordinates(reader, posed.part, posed.weights, posed.positions.count, from, what);
    std::vector<glm::vec2> at;
    at.reserve(local.vertices.size());
    for (const std::uint32_t vertex : local.vertices) at.push_back(of_vertices[vertex]);
    return at;
}

std::vector<glm::vec4> read_tangents(AccessorReader& reader, const PosedPart& posed,
                                     const Local& local) {
    const Elements given =
        read_morphed(reader, posed.part, tangents, posed.weights, posed.positions.count);
    std::vector<glm::vec4> result;
    result.reserve(local.vertices.size());
    for (const std::uint32_t vertex : local.vertices) {
        const double* v = given.values.data() + 4 * std::size_t{vertex};
        if (std::abs(v[3]) != 1)
            (posed.part.place / "attributes" / tangents.name)
                .refuse(fmt::format("element {} has the w {}", vertex, v[3]), "write 1 or -1");
        result.emplace_back(v[0], v[1], v[2], v[3]);
    }
    return result;
}

std::vector<glm::vec4> made_tangents(const PosedPart& posed, const Local& local) {
    std::vector<TexturedCorner> corners;
    corners.reserve(local.vertices.size());
    for (std::size_t i = 0; i < local.vertices.size(); ++i)
        corners.push_back({glm::vec3(posed.positions.vec3(local.vertices[i])),
                           glm::vec3(local.normals[i]), local.bump_at[i]});
    return make_tangents(corners);
}

/// Transforms directions from the mesh's space to the world.
class Placing {
public:
    explicit Placing(const PosedPart& posed) : posed_(posed) { set(posed.world_from_node); }

    void set_vertex(std::size_t vertex) {
        if (posed_.skin && posed_.influences)
            set(deformation(*posed_.skin, *posed_.influences, vertex));
    }
    bool mirrors() const { return mirrors_; }
    glm::dvec3 tangent(const glm::dvec3& t) const { return world_ * t; }
    /// The cofactors are the inverse transpose times the determinant, whose sign alone counts.
    glm::dvec3 normal(const glm::dvec3& n) const { return cofactors_ * (mirrors_ ? -n : n); }

private:
    const PosedPart& posed_;
    glm::dmat3 world_{1.0};
    glm::dmat3 cofactors_{1.0};
    bool mirrors_ = false;

    void set(const glm::dmat3& world) {
        world_ = world;
        cofactors_ = glm::dmat3(glm::cross(world[1], world[2]), glm::cross(world[2], world[0]),
                                glm::cross(world[0], world[1]));
        mirrors_ = glm::determinant(world) < 0;
    }
};

Surface placed(const Placing& placing, const Local& local, std::size_t corner) {
    Surface surface;
    const glm::dvec3 normal = unit_or(placing.normal(local.normals[corner]), local.normals[corner]);
    surface.normal = glm::vec3(normal);
    if (!local.decal_at.empty()) surface.decal_at = local.decal_at[corner];
    if (!local.bump_at.empty()) surface.bump_at = local.bump_at[corner];
    if (local.tangents.empty()) return surface;
    const glm::vec4& tangent = local.tangents[corner];
    surface.tangent =
        glm::vec4(glm::vec3(unit_or(placing.tangent(glm::dvec3(tangent)), any_tangent(normal))),
                  placing.mirrors() ? -tangent.w : tangent.w);
    return surface;
}

/// A triangle lies in one chart, so its corners should agree on w; where they do not, its first
/// corner decides.
void settle_hands(const PosedPart& posed, std::vector<glm::vec4>& tangents_of_corners,
                  std::vector<std::string>& notes) {
    std::size_t mixed = 0;
    for (std::size_t i = 0; i + 2 < tangents_of_corners.size(); i += 3) {
        glm::vec4* corner = tangents_of_corners.data() + i;
        mixed += corner[1].w != corner[0].w || corner[2].w != corner[0].w ? 1 : 0;
        corner[1].w = corner[2].w = corner[0].w;
    }
    if (mixed > 0)
        notes.push_back(fmt::format("{}/attributes/TANGENT: {} triangles have tangents of either "
                                    "hand, the first corner's is taken",
                                    posed.part.place.pointer(), mixed));
}

} // namespace

std::vector<glm::vec2> texture_coordinates(AccessorReader& reader, const Part& part,
                                           const std::vector<double>& weights, std::size_t vertices,
                                           const Coordinates& from, const char* what) {
    const Attribute wanted = coordinates(from.set);
    if (!has_attribute(part, wanted))
        (part.place / "attributes")
            .refuse(fmt::format("\"{}\" is missing", wanted.name),
                    fmt::format("add it, for the material has {}", what));
    const Elements given = read_morphed(reader, part, wanted, weights, vertices);
    std::vector<glm::vec2> at;
    at.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        at.emplace_back(from.transform *
                        glm::dvec3(given.values[2 * i], given.values[2 * i + 1], 1));
        if (!std::isfinite(at.back().x) || !std::isfinite(at.back().y)) // as morphed and placed
            (part.place / "attributes" / wanted.name)
                .refuse(fmt::format("vertex {} has coordinates that are not finite", i),
                        "scale its displacements or its texture's transform down");
    }
    return at;
}

std::vector<glm::vec3> world_normals(AccessorReader& reader, const PosedPart& posed) {
    if (!has_attribute(posed.part, normals)) return {};
    const Elements given =
        read_morphed(reader, posed.part, normals, posed.weights, posed.positions.count);
    Placing placing(posed);
    std::vector<glm::vec3> world;
    world.reserve(posed.positions.count);
    for (std::size_t i = 0; i < posed.positions.count; ++i) {
        placing.set_vertex(i);
        world.emplace_back(unit_or(placing.normal(given.vec3(i)), {0, 0, 0}));
    }
    return world;
}

void append_surfaces(AccessorReader& reader, const PosedPart& posed, const Material& material,
                     const CoordinateSets& sets, Scene& scene) {
    if (scene.surfaces.size() / 3 + posed.triangles.size() > limits.surfaces)
        posed.part.place.refuse(
            fmt::format("brings a scene with bump maps above {} triangles", limits.surfaces),
            "split the asset, or take its bump maps away");
    const std::uint64_t corners = 3 * posed.triangles.size();
    const std::string where = posed.part.place.where();
    const char* const split = "split the asset, or take its bump maps away";
    reader.memory().keep(
        {3 * corners * sizeof(Surface), where, "its corners' normals and tangents", split});
    const MemoryHold held =
        reader.memory().hold({corners * corner_bytes, where, "making its tangents", split});
    Local local;
    local.vertices = vertices_of(posed.triangles);
    read_normals(reader, posed, local);
    if (material.decal != no_texture)
        local.decal_at = read_coordinates(reader, posed, local, sets.decal, "a decal");
    if (material.bump != Bump::none) {
        local.bump_at = read_coordinates(reader, posed, local, sets.bump, "a bump map");
        const bool given =
            has_attribute(posed.part, normals) && has_attribute(posed.part, tangents);
        local.tangents = given ? read_tangents(reader, posed, local) : made_tangents(posed, local);
        settle_hands(posed, local.tangents, scene.notes);
    }
    if (posed.part.primitive.attributes.count("COLOR_0") != 0)
        scene.notes.push_back(posed.part.place.pointer() + "/attributes/COLOR_0 is not evaluated");
    Placing placing(posed);
    constexpr std::size_t swapped[] = {0, 2, 1};
    for (std::size_t i = 0; i < local.vertices.size(); ++i) {
        const std::size_t corner = posed.mirrored ? i - i % 3 + swapped[i % 3] : i;
        placing.set_vertex(local.vertices[corner]);
        scene.surfaces.push_back(placed(placing, local, corner));
    }
}

} // namespace shadowproof::gltf
