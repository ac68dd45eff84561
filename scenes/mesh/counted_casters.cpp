#include "scenes/mesh/counted_casters.h"

#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/holes.h"
#include "scenes/mesh/topology.h"
#include "scenes/mesh/union_find.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

/// Triangles of casters that are connected by shared edges.
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
    UnionFind connected(scene.triangles.size());
    for (const HalfEdge& half_edge : mesh.half_edges)
        if (half_edge.twin != no_half_edge)
            connected.unite(half_edge.triangle, mesh.half_edges[half_edge.twin].triangle);
    std::vector<Shell> of_first(scene.triangles.size());
    for (std::size_t i = 0; i < mesh.half_edges.size(); ++i) {
        const HalfEdge& half_edge = mesh.half_edges[i];
        Shell& shell = of_first[connected.find(half_edge.triangle)];
        if (i % 3 == 0) shell.triangles.push_back(half_edge.triangle);
        shell.closed = shell.closed && half_edge.twin != no_half_edge;
    }
    std::erase_if(of_first, [](const Shell& shell) { return shell.triangles.empty(); });
    return of_first;
}

/// Whether a shell contains the light: the solid angles of its triangles, as seen from there (van
/// Oosterom & Strackee 1983), add up to more than zero. From inside the sum is the whole sphere,
/// from a point on the shell a part of it, from outside what rounding leaves: a few 2^-53 per
/// triangle, which for millions of them is far less than the limit. A triangle next to the light
/// fills half the sky one way or the other: its sign is exact.
bool holds_light(const Scene& scene, const Shell& shell) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return false; // it is outside of every shell
    constexpr double limit = 0x1p-20;
    double half_of_solid_angle = 0;
    for (const std::uint32_t triangle : shell.triangles) {
        const glm::dvec3 a = corner(scene, triangle, 0) - light.position;
        const glm::dvec3 b = corner(scene, triangle, 1) - light.position;
        const glm::dvec3 c = corner(scene, triangle, 2) - light.position;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        const double facing = side(scene, triangle, homogeneous(light));
        const double size = std::abs(glm::dot(a, glm::cross(b, c)));
        half_of_solid_angle += std::atan2(facing == 0 ? 0 : std::copysign(size, -facing),
                                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                                              glm::dot(c, a) * lb);
    }
    return half_of_solid_angle > limit;
}

/// A mesh is left out as a whole or not at all.
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

std::vector<std::uint8_t> triangles_to_flip(const Scene& scene) {
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

Scene counted_casters(const Scene& scene, const Counting& counting,
                      const std::vector<std::uint8_t>& flipped) {
    Scene casters = counting.holes_filled ? with_holes_filled(scene) : scene;
    for (std::size_t triangle = 0; triangle < flipped.size(); ++triangle)
        if (flipped[triangle] != 0)
            std::swap(casters.triangles[triangle].x, casters.triangles[triangle].y);
    leave_out(casters, counting);
    return casters;
}

} // namespace shadowproof
