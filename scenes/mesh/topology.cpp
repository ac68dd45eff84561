#include "scenes/mesh/topology.h"

#include "scenes/mesh/first_of_same.h"
#include "scenes/roundoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <string_view>
#include <tuple>
#include <utility>

namespace shadowproof {

std::vector<std::uint32_t> weld_by_position(std::span<const glm::vec3> positions) {
    std::vector<std::uint64_t> hashes;
    hashes.reserve(positions.size());
    for (const glm::vec3& position : positions) hashes.push_back(hash_of(position));
    return first_of_same(
        hashes, [&](std::uint32_t i, std::uint32_t k) { return positions[i] == positions[k]; });
}

namespace {

/// All triangles of an edge low < high: how many run it from low to high, and how many back.
struct EdgeUse {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    int up = 0;
    int down = 0;
};

/// Calls visit(a, b) for the three directed edges of each triangle that has an area.
template <class Visit>
void for_each_edge(const Scene& scene, std::span<const std::uint32_t> welded,
                   std::span<const std::uint32_t> triangles, const Visit& visit) {
    for (const std::uint32_t triangle : triangles) {
        const glm::uvec3& corners = scene.triangles[triangle];
        const std::uint32_t a = welded[corners.x];
        const std::uint32_t b = welded[corners.y];
        const std::uint32_t c = welded[corners.z];
        if (a == b || b == c || c == a) continue;
        visit(a, b);
        visit(b, c);
        visit(c, a);
    }
}

/// By low, then high. Each low vertex has a bucket of a few edges, so that sorting within it costs
/// next to nothing.
std::vector<EdgeUse> edges_used(const Scene& scene, std::span<const std::uint32_t> welded,
                                std::span<const std::uint32_t> triangles) {
    std::vector<std::size_t> first(scene.positions.size() + 1, 0); // of each bucket
    for_each_edge(scene, welded, triangles,
                  [&](std::uint32_t a, std::uint32_t b) { ++first[std::min(a, b) + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint64_t> entries(first.back()); // high vertex, then 1 for downwards
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for_each_edge(scene, welded, triangles, [&](std::uint32_t a, std::uint32_t b) {
        entries[next[std::min(a, b)]++] = std::uint64_t{std::max(a, b)} << 1U | (a > b ? 1U : 0U);
    });
    std::vector<EdgeUse> edges;
    for (std::size_t low = 0; low + 1 < first.size(); ++low) {
        const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(first[low]);
        const auto end = entries.begin() + static_cast<std::ptrdiff_t>(first[low + 1]);
        std::sort(begin, end);
        for (auto entry = begin; entry != end; ++entry) {
            const auto high = static_cast<std::uint32_t>(*entry >> 1U);
            if (entry == begin || edges.back().high != high)
                edges.push_back({static_cast<std::uint32_t>(low), high, 0, 0});
            ++((*entry & 1U) != 0 ? edges.back().down : edges.back().up);
        }
    }
    return edges;
}

std::uint32_t end_of(const HalfEdgeMesh& mesh, const HalfEdge& half_edge) {
    return mesh.half_edges[half_edge.next].origin;
}

/// Edges with a surplus: those of several units stand side by side in mesh.edges.
std::size_t count_boundary_edges(const HalfEdgeMesh& mesh) {
    std::size_t count = 0;
    std::pair<std::uint32_t, std::uint32_t> last{0, 0};
    for (const Edge& edge : mesh.edges) {
        if (edge.twin != no_half_edge) continue;
        const HalfEdge& half_edge = mesh.half_edges[edge.half_edge];
        const std::pair ends = std::minmax({half_edge.origin, end_of(mesh, half_edge)});
        count += ends != last ? 1U : 0U;
        last = ends;
    }
    return count;
}

CasterReport inspect(const Scene& scene, std::span<const std::uint32_t> welded,
                     std::uint32_t mesh) {
    const std::vector<std::uint32_t> triangles = triangles_of(scene.meshes[mesh]);
    const HalfEdgeMesh connected = connect(scene, welded, triangles);
    CasterReport report;
    report.mesh = mesh;
    report.boundary_edges = count_boundary_edges(connected);
    report.rings = boundary_rings(connected).size();
    for (const EdgeFault& fault : connected.faults)
        ++(fault.non_manifold() ? report.non_manifold_edges : report.inconsistent_edges);
    if (!connected.faults.empty()) report.first_fault = connected.faults.front();
    report.inverted = report.closed() && encloses_negative_volume(scene, triangles);
    return report;
}

/// Finds the open meshes that the other open ones close.
void mark_closed_by_others(const Scene& scene, std::span<const std::uint32_t> welded,
                           std::vector<CasterReport>& reports) {
    std::vector<std::uint32_t> triangles; // of all open meshes
    for (const CasterReport& report : reports) {
        if (report.closed()) continue;
        const std::vector<std::uint32_t> more = triangles_of(scene.meshes[report.mesh]);
        triangles.insert(triangles.end(), more.begin(), more.end());
    }
    if (triangles.empty()) return;
    const HalfEdgeMesh connected = connect(scene, welded, triangles);
    std::vector<std::uint8_t> left_open(scene.meshes.size(), 0);
    for (const HalfEdge& half_edge : connected.half_edges)
        if (half_edge.twin == no_half_edge) left_open[mesh_of(scene, half_edge.triangle)] = 1;
    for (CasterReport& report : reports)
        report.closed_by_others = !report.closed() && left_open[report.mesh] == 0;
}

/// "1 ring", "2 rings".
std::string counted(std::size_t count, std::string_view singular, std::string_view plural) {
    return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

} // namespace

std::vector<std::uint32_t> triangles_of(const Mesh& mesh) {
    std::vector<std::uint32_t> triangles(mesh.triangle_count);
    std::iota(triangles.begin(), triangles.end(), mesh.first_triangle);
    return triangles;
}

std::vector<SurplusEdge> boundary(const Scene& scene, std::span<const std::uint32_t> welded,
                                  std::span<const std::uint32_t> triangles) {
    std::vector<SurplusEdge> result;
    for (const EdgeUse& edge : edges_used(scene, welded, triangles)) {
        if (edge.up > edge.down) result.push_back({edge.low, edge.high, edge.up - edge.down});
        if (edge.up < edge.down) result.push_back({edge.high, edge.low, edge.down - edge.up});
    }
    std::sort(result.begin(), result.end(), [](const SurplusEdge& left, const SurplusEdge& right) {
        return std::tie(left.a, left.b) < std::tie(right.a, right.b);
    });
    return result;
}

// Each triangle spans a tetrahedron with the first corner; six times their volumes are summed. A
// term is off by at most 16 2^-53 of `size`, the product of the lengths of its edges, and the sum
// by n 2^-53 times the sum of the sizes.
bool encloses_negative_volume(const Scene& scene, std::span<const std::uint32_t> triangles) {
    if (triangles.empty()) return false;
    const glm::dvec3 origin = corner(scene, triangles.front(), 0);
    double volume = 0;
    double size = 0;
    for (const std::uint32_t triangle : triangles) {
        const glm::dvec3 a = corner(scene, triangle, 0) - origin;
        const glm::dvec3 b = corner(scene, triangle, 1) - origin;
        const glm::dvec3 c = corner(scene, triangle, 2) - origin;
        volume += glm::dot(a, glm::cross(b, c));
        size += glm::length(a) * glm::length(b) * glm::length(c);
    }
    return volume < -(16 + static_cast<double>(triangles.size())) * double_roundoff * size;
}

std::vector<CasterReport> inspect_casters(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weld_by_position(scene.positions);
    std::vector<CasterReport> reports;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        if (scene.meshes[mesh].casts)
            reports.push_back(inspect(scene, welded, static_cast<std::uint32_t>(mesh)));
    mark_closed_by_others(scene, welded, reports);
    return reports;
}

std::string words_of(const Scene& scene, const CasterReport& report) {
    const std::string caster = fmt::format("caster '{}'", scene.meshes[report.mesh].name);
    constexpr std::string_view outlook =
        "; techniques that need closed volumes may fail (open_mesh)";
    if (report.inverted)
        return fmt::format("{} is wound inside out: the volume it encloses is negative{}", caster,
                           outlook);
    std::string faults;
    if (report.non_manifold_edges > 0)
        faults += ", " + counted(report.non_manifold_edges, "edge", "edges") +
                  " of more than two triangles";
    if (report.inconsistent_edges > 0)
        faults += ", " + counted(report.inconsistent_edges, "edge", "edges") +
                  " run the same way by both triangles";
    if (report.first_fault)
        faults += fmt::format(" (first {})", place_of(scene, *report.first_fault));
    if (!report.encloses_volume())
        return fmt::format("{} is open: {} in {}{}{}", caster,
                           counted(report.boundary_edges, "boundary edge", "boundary edges"),
                           counted(report.rings, "ring", "rings"), faults, outlook);
    if (faults.empty()) return {};
    return fmt::format("{} is not two-manifold: {}; it encloses a volume all the same", caster,
                       faults.substr(2));
}

} // namespace shadowproof
