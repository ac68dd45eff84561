#include "scenes/topology.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace shadowproof {

std::vector<std::uint32_t> weld_by_position(std::span<const glm::vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
        const glm::vec3& a = positions[i];
        const glm::vec3& b = positions[k];
        return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, k);
    });
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        welded[order[i]] = same ? welded[order[i - 1]] : order[i];
    }
    return welded;
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

/// By low, then high. Buckets by the low vertex hold a handful of edges each, so that the sorting
/// within them is next to free.
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

/// Connected groups of the edges with a surplus.
std::size_t count_rings(const std::vector<EdgeUse>& edges) {
    std::vector<std::uint32_t> ends;
    for (const EdgeUse& edge : edges)
        if (edge.up != edge.down) ends.insert(ends.end(), {edge.low, edge.high});
    std::vector<std::uint32_t> vertices = ends;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<std::size_t> leader(vertices.size());
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto find = [&](std::uint32_t vertex) {
        auto i = static_cast<std::size_t>(
            std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
        while (leader[i] != i) i = leader[i] = leader[leader[i]];
        return i;
    };
    std::size_t rings = vertices.size();
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        const std::size_t a = find(ends[i]);
        const std::size_t b = find(ends[i + 1]);
        if (a == b) continue;
        leader[a] = b;
        --rings;
    }
    return rings;
}

} // namespace

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

std::vector<CasterReport> inspect_casters(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weld_by_position(scene.positions);
    std::vector<CasterReport> reports;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (!scene.meshes[mesh].casts) continue;
        std::vector<std::uint32_t> triangles(scene.meshes[mesh].triangle_count);
        std::iota(triangles.begin(), triangles.end(), scene.meshes[mesh].first_triangle);
        const std::vector<EdgeUse> edges = edges_used(scene, welded, triangles);
        CasterReport report;
        report.mesh = static_cast<std::uint32_t>(mesh);
        for (const EdgeUse& edge : edges) {
            report.boundary_edges += edge.up != edge.down ? 1U : 0U;
            report.non_manifold_edges += edge.up + edge.down > 2 ? 1U : 0U;
        }
        report.rings = count_rings(edges);
        reports.push_back(report);
    }
    return reports;
}

} // namespace shadowproof
