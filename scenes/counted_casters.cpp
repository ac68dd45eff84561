#include "scenes/counted_casters.h"

#include "scenes/half_edge.h"
#include "scenes/holes.h"
#include "scenes/topology.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace shadowproof {

namespace {

/// Triangles of casters that hang together by edges.
struct Shell {
    std::vector<std::uint32_t> triangles;
    bool closed = true;
};

std::vector<Shell> shells_of(const Scene& scene) {
    std::vector<std::uint32_t> casters;
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle)
        if (casts[triangle] != 0) casters.push_back(triangle);
    const HalfEdgeMesh mesh = connect(scene, weld_by_position(scene.positions), casters);
    std::vector<std::uint32_t> parent(scene.triangles.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t triangle) {
        while (parent[triangle] != triangle) triangle = parent[triangle] = parent[parent[triangle]];
        return triangle;
    };
    for (const HalfEdge& half_edge : mesh.half_edges)
        if (half_edge.twin != no_half_edge)
            parent[root(half_edge.triangle)] = root(mesh.half_edges[half_edge.twin].triangle);
    std::vector<Shell> of_root(scene.triangles.size());
    for (std::size_t i = 0; i < mesh.half_edges.size(); ++i) {
        const HalfEdge& half_edge = mesh.half_edges[i];
        Shell& shell = of_root[root(half_edge.triangle)];
        if (i % 3 == 0) shell.triangles.push_back(half_edge.triangle);
        shell.closed = shell.closed && half_edge.twin != no_half_edge;
    }
    std::erase_if(of_root, [](const Shell& shell) { return shell.triangles.empty(); });
    return of_root;
}

/// Whether a shell winds around the light: the solid angles that its triangles fill as seen from
/// there (van Oosterom & Strackee 1983) add up to more than nothing. From inside they are the whole
/// sphere, from a point on the shell a part of it, from outside what rounding leaves: a few 2^-53 a
/// triangle, of which millions are far less than the limit.
bool holds_light(const Scene& scene, const Shell& shell) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return false; // it shines from outside of all
    constexpr double limit = 0x1p-20;
    double half_of_solid_angle = 0;
    for (const std::uint32_t triangle : shell.triangles) {
        const glm::dvec3 a = corner(scene, triangle, 0) - light.position;
        const glm::dvec3 b = corner(scene, triangle, 1) - light.position;
        const glm::dvec3 c = corner(scene, triangle, 2) - light.position;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        half_of_solid_angle += std::atan2(glm::dot(a, glm::cross(b, c)),
                                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                                              glm::dot(c, a) * lb);
    }
    return half_of_solid_angle > limit;
}

/// Meshes are left out as wholes.
void leave_out(Scene& scene, const Counting& counting) {
    for (Mesh& mesh : scene.meshes)
        if (mesh.triangle_count > 0 && counting.caster(mesh.first_triangle).left_out)
            mesh.casts = false;
}

} // namespace

std::vector<std::uint8_t> triangles_around_light(const Scene& scene) {
    std::vector<std::uint8_t> flags;
    for (const Shell& shell : shells_of(scene)) {
        if (!shell.closed || !holds_light(scene, shell)) continue;
        flags.resize(scene.triangles.size(), 0);
        for (const std::uint32_t triangle : shell.triangles) flags[triangle] = 1;
    }
    return flags;
}

std::vector<std::uint8_t> triangles_to_turn(const Scene& scene) {
    std::vector<std::uint8_t> flags;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    for (const Shell& shell : shells_of(scene)) {
        const bool outward = shell.closed && !encloses_negative_volume(scene, shell.triangles);
        const bool around_light = outward && holds_light(scene, shell);
        if (outward && !around_light) continue;
        flags.resize(scene.triangles.size(), 0);
        for (const std::uint32_t triangle : shell.triangles)
            flags[triangle] = around_light || side(scene, triangle, light) < 0 ? 1 : 0;
    }
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
