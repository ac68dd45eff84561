#include "scenes/counted_casters.h"

#include "scenes/half_edge.h"
#include "scenes/holes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace shadowproof {

namespace {

/// How often triangles wind around a point: the solid angles that they fill as seen from it, over
/// the whole sphere's (van Oosterom & Strackee 1983). Positive inside what is wound outwards.
double winding_number(const Scene& scene, std::span<const std::uint32_t> triangles,
                      const glm::dvec3& point) {
    double halves = 0;
    for (const std::uint32_t triangle : triangles) {
        const glm::dvec3 a = corner(scene, triangle, 0) - point;
        const glm::dvec3 b = corner(scene, triangle, 1) - point;
        const glm::dvec3 c = corner(scene, triangle, 2) - point;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        halves += std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                glm::dot(b, c) * la +
                                                                glm::dot(c, a) * lb);
    }
    constexpr double whole_sphere = 6.283185307179586; // as halves of 4 pi
    return halves / whole_sphere;
}

/// The bodies that casters make up: each closed mesh by itself, and the meshes that only together
/// are closed.
std::vector<std::vector<std::uint32_t>> closed_bodies(const Scene& scene,
                                                      std::span<const CasterReport> casters) {
    std::vector<std::vector<std::uint32_t>> bodies;
    std::vector<std::uint32_t> in_parts;
    for (const CasterReport& report : casters) {
        std::vector<std::uint32_t> triangles = triangles_of(scene.meshes[report.mesh]);
        if (report.closed())
            bodies.push_back(std::move(triangles));
        else if (report.closed_by_others)
            in_parts.insert(in_parts.end(), triangles.begin(), triangles.end());
    }
    bodies.push_back(std::move(in_parts));
    return bodies;
}

bool is_inside(const Scene& scene, std::span<const std::uint32_t> body, const Light& light) {
    return light.kind != Light::Kind::directional && // which shines from outside of all
           winding_number(scene, body, light.position) > 0.5;
}

/// Triangles that hang together by edges, shell by shell.
std::vector<std::vector<std::uint32_t>> shells_of(const HalfEdgeMesh& mesh, std::size_t triangles) {
    std::vector<std::uint32_t> parent(triangles);
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t triangle) {
        while (parent[triangle] != triangle) triangle = parent[triangle] = parent[parent[triangle]];
        return triangle;
    };
    for (const HalfEdge& half_edge : mesh.half_edges)
        if (half_edge.twin != no_half_edge)
            parent[root(half_edge.triangle)] = root(mesh.half_edges[half_edge.twin].triangle);
    std::vector<std::vector<std::uint32_t>> of_root(triangles);
    for (std::size_t i = 0; i < mesh.half_edges.size(); i += 3)
        of_root[root(mesh.half_edges[i].triangle)].push_back(mesh.half_edges[i].triangle);
    std::erase_if(of_root, [](const auto& shell) { return shell.empty(); });
    return of_root;
}

/// Whether, with the flagged triangles turned round, every way out of the light meets a triangle
/// that faces it before one that does not.
bool facing_ones_throw_all_shadows(const Scene& scene,
                                   const std::vector<std::uint8_t>& around_light) {
    std::vector<std::uint32_t> casters;
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle)
        if (casts[triangle] != 0) casters.push_back(triangle);
    const HalfEdgeMesh mesh = connect(scene, weld_by_position(scene.positions), casters);
    const auto is_boundary = [](const Edge& edge) { return edge.twin == no_half_edge; };
    if (std::any_of(mesh.edges.begin(), mesh.edges.end(), is_boundary)) return false;
    const auto is_turned = [&](std::uint32_t triangle) {
        return !around_light.empty() && around_light[triangle] != 0;
    };
    const std::vector<std::vector<std::uint32_t>> shells = shells_of(mesh, scene.triangles.size());
    return std::all_of(shells.begin(), shells.end(), [&](const auto& shell) {
        const bool turned = std::all_of(shell.begin(), shell.end(), is_turned);
        return !encloses_negative_volume(scene, shell) &&
               turned == is_inside(scene, shell, chosen_light(scene));
    });
}

/// Meshes are left out as wholes.
void leave_out(Scene& scene, const Counting& counting) {
    for (Mesh& mesh : scene.meshes)
        if (mesh.triangle_count > 0 && counting.caster(mesh.first_triangle).left_out)
            mesh.casts = false;
}

} // namespace

std::vector<std::uint8_t> triangles_around_light(const Scene& scene,
                                                 std::span<const CasterReport> casters) {
    std::vector<std::uint8_t> flags;
    for (const std::vector<std::uint32_t>& body : closed_bodies(scene, casters)) {
        if (!is_inside(scene, body, chosen_light(scene))) continue;
        flags.resize(scene.triangles.size(), 0);
        for (const std::uint32_t triangle : body) flags[triangle] = 1;
    }
    return flags;
}

std::vector<std::uint8_t>
triangles_averted_from_light(const Scene& scene, const std::vector<std::uint8_t>& around_light) {
    if (facing_ones_throw_all_shadows(scene, around_light)) return around_light;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    std::vector<std::uint8_t> flags = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < flags.size(); ++triangle)
        if (side(scene, triangle, light) >= 0) flags[triangle] = 0;
    return flags;
}

Scene counted_casters(const Scene& scene, const Counting& counting) {
    Scene casters = counting.holes_filled ? with_holes_filled(scene) : scene;
    for (std::size_t triangle = 0; triangle < counting.turned.size(); ++triangle)
        if (counting.turned[triangle] != 0)
            std::swap(casters.triangles[triangle].x, casters.triangles[triangle].y);
    leave_out(casters, counting);
    return casters;
}

bool leaves_casters_out(const Counting& counting) {
    return std::any_of(counting.casters.begin(), counting.casters.end(),
                       [](const Counting::Caster& caster) { return caster.left_out; });
}

} // namespace shadowproof
