#include "scenes/mesh/half_edge.h"

#include "scenes/mesh/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace shadowproof {

namespace {

std::vector<HalfEdge> half_edges_of(const Scene& scene, std::span<const std::uint32_t> welded,
                                    std::span<const std::uint32_t> triangles) {
    std::vector<HalfEdge> half_edges;
    half_edges.reserve(3 * triangles.size());
    for (const std::uint32_t triangle : triangles) {
        const glm::uvec3& corners = scene.triangles[triangle];
        const glm::uvec3 origins(welded[corners.x], welded[corners.y], welded[corners.z]);
        if (origins.x == origins.y || origins.y == origins.z || origins.z == origins.x) continue;
        const auto first = static_cast<std::uint32_t>(half_edges.size());
        for (int k = 0; k < 3; ++k)
            half_edges.push_back({origins[k], first + static_cast<std::uint32_t>((k + 1) % 3),
                                  no_half_edge, triangle});
    }
    return half_edges;
}

/// A half-edge in the bucket of its lower vertex.
struct Entry {
    std::uint32_t high = 0; ///< its other vertex
    std::uint32_t half_edge = 0;
};

/// All half-edges, by their lower vertex, then the higher, then their own order.
std::vector<Entry> entries_by_edge(const std::vector<HalfEdge>& half_edges) {
    if (half_edges.empty()) return {};
    const auto [lowest, highest] = std::minmax_element(
        half_edges.begin(), half_edges.end(),
        [](const HalfEdge& left, const HalfEdge& right) { return left.origin < right.origin; });
    const std::size_t base = lowest->origin;
    std::vector<std::size_t> first(highest->origin - base + 2, 0); // of each bucket
    const auto ends_of = [&](const HalfEdge& half_edge) {
        return std::minmax(half_edge.origin, half_edges[half_edge.next].origin);
    };
    for (const HalfEdge& half_edge : half_edges) ++first[ends_of(half_edge).first - base + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Entry> entries(half_edges.size());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < half_edges.size(); ++i) {
        const auto [low, high] = ends_of(half_edges[i]);
        entries[next[low - base]++] = {high, i};
    }
    for (std::size_t bucket = 0; bucket + 1 < first.size(); ++bucket)
        std::sort(entries.begin() + static_cast<std::ptrdiff_t>(first[bucket]),
                  entries.begin() + static_cast<std::ptrdiff_t>(first[bucket + 1]),
                  [](const Entry& left, const Entry& right) {
                      return std::tie(left.high, left.half_edge) <
                             std::tie(right.high, right.half_edge);
                  });
    return entries;
}

/// Gives twins to the half-edges of one edge from a to b, a < b, and adds it to the mesh.
void pair_up(HalfEdgeMesh& mesh, std::uint32_t a, std::uint32_t b,
             std::span<const std::uint32_t> up, std::span<const std::uint32_t> down) {
    const std::size_t pairs = std::min(up.size(), down.size());
    for (std::size_t i = 0; i < pairs; ++i) {
        mesh.half_edges[up[i]].twin = down[i];
        mesh.half_edges[down[i]].twin = up[i];
        mesh.edges.push_back({up[i], down[i]});
    }
    for (const std::uint32_t single : up.subspan(pairs)) mesh.edges.push_back({single});
    for (const std::uint32_t single : down.subspan(pairs)) mesh.edges.push_back({single});
    if (up.size() < 2 && down.size() < 2) return;
    mesh.faults.push_back({a, b, static_cast<std::uint32_t>(up.size()),
                           static_cast<std::uint32_t>(down.size()),
                           mesh.half_edges[up.empty() ? down.front() : up.front()].triangle});
}

/// From a boundary half-edge around the triangles at its end to the boundary half-edge that leaves
/// there. Each half-edge into the vertex has one successor, and none leads back to the boundary
/// that the walk came from, so it ends.
std::uint32_t next_on_boundary(const HalfEdgeMesh& mesh, std::uint32_t half_edge) {
    std::uint32_t leaving = mesh.half_edges[half_edge].next;
    while (mesh.half_edges[leaving].twin != no_half_edge)
        leaving = mesh.half_edges[mesh.half_edges[leaving].twin].next;
    return leaving;
}

/// A walk along a boundary, from which rings are split off.
struct Walk {
    Ring path;
    std::unordered_map<std::uint32_t, std::size_t> place; ///< of each vertex in the path

    /// The part of the path since it was at `vertex` last; empty where it never was.
    Ring split_off(std::uint32_t vertex) {
        const auto found = place.find(vertex);
        if (found == place.end()) return {};
        const auto first = path.begin() + static_cast<std::ptrdiff_t>(found->second);
        Ring ring(first, path.end());
        path.erase(first, path.end());
        for (const std::uint32_t left : ring) place.erase(left);
        return ring;
    }

    void step_to(std::uint32_t vertex) {
        place[vertex] = path.size();
        path.push_back(vertex);
    }
};

std::string words_of(const glm::vec3& v) {
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

} // namespace

HalfEdgeMesh connect(const Scene& scene, std::span<const std::uint32_t> welded,
                     std::span<const std::uint32_t> triangles) {
    HalfEdgeMesh mesh;
    mesh.half_edges = half_edges_of(scene, welded, triangles);
    mesh.edges.reserve(mesh.half_edges.size() / 2);
    const std::vector<Entry> entries = entries_by_edge(mesh.half_edges);
    std::vector<std::uint32_t> up; // the half-edges from the lower vertex to the higher
    std::vector<std::uint32_t> down;
    for (auto entry = entries.begin(); entry != entries.end();) {
        const auto low_of = [&](const Entry& e) {
            const HalfEdge& half_edge = mesh.half_edges[e.half_edge];
            return std::min(half_edge.origin, mesh.half_edges[half_edge.next].origin);
        };
        const std::uint32_t low = low_of(*entry);
        const std::uint32_t high = entry->high;
        up.clear();
        down.clear();
        for (; entry != entries.end() && entry->high == high && low_of(*entry) == low; ++entry)
            (mesh.half_edges[entry->half_edge].origin == low ? up : down)
                .push_back(entry->half_edge);
        pair_up(mesh, low, high, up, down);
    }
    return mesh;
}

HalfEdgeMesh connect_all(const Scene& scene) {
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return connect(scene, weld_by_position(scene.positions), all);
}

std::string place_of(const Scene& scene, const EdgeFault& fault) {
    return words_of(scene.positions[fault.a]) + " to " + words_of(scene.positions[fault.b]);
}

std::string words_of(const Scene& scene, const EdgeFault& fault) {
    const std::string edge =
        fmt::format("mesh '{}': the edge {}", scene.meshes[mesh_of(scene, fault.triangle)].name,
                    place_of(scene, fault));
    if (!fault.non_manifold()) return edge + " is run the same way by both its triangles";
    return fmt::format("{} belongs to {} triangles", edge, fault.from_a_to_b + fault.from_b_to_a);
}

std::vector<Ring> boundary_rings(const HalfEdgeMesh& mesh) {
    std::vector<Ring> rings;
    std::vector<std::uint8_t> walked(mesh.half_edges.size(), 0);
    for (std::uint32_t start = 0; start < mesh.half_edges.size(); ++start) {
        if (mesh.half_edges[start].twin != no_half_edge || walked[start] != 0) continue;
        Walk walk;
        std::uint32_t half_edge = start;
        do {
            walked[half_edge] = 1;
            const std::uint32_t vertex = mesh.half_edges[half_edge].origin;
            if (Ring ring = walk.split_off(vertex); !ring.empty()) rings.push_back(std::move(ring));
            walk.step_to(vertex);
            half_edge = next_on_boundary(mesh, half_edge);
        } while (half_edge != start);
        rings.push_back(std::move(walk.path));
    }
    return rings;
}

std::vector<glm::uvec3> fill_holes(const HalfEdgeMesh& mesh) {
    std::vector<glm::uvec3> triangles;
    for (const Ring& ring : boundary_rings(mesh)) // its filling runs a ring backwards
        for (std::size_t i = 2; i < ring.size(); ++i)
            triangles.emplace_back(ring[0], ring[i], ring[i - 1]);
    return triangles;
}

} // namespace shadowproof
