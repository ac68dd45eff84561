#include "scenes/surface/tangents.h"

#include "scenes/mesh/union_find.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace shadowproof {

namespace {

using Key = std::array<std::uint32_t, 8>;

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 14695981039346656037U; // FNV-1a, word by word
        for (const std::uint32_t word : key) hash = (hash ^ word) * 1099511628211U;
        return hash ^ hash >> 32U;
    }
};

/// Bits that are equal where the floats are.
std::uint32_t bits_of(float value) {
    return std::bit_cast<std::uint32_t>(value + 0.0F); // -0 becomes +0
}

/// The vertex number of every corner, in order of first use.
std::vector<std::uint32_t> weld(const std::vector<TexturedCorner>& corners) {
    std::unordered_map<Key, std::uint32_t, KeyHash> known;
    std::vector<std::uint32_t> vertices;
    vertices.reserve(corners.size());
    for (const TexturedCorner& c : corners) {
        const Key key{bits_of(c.position.x), bits_of(c.position.y), bits_of(c.position.z),
                      bits_of(c.normal.x),   bits_of(c.normal.y),   bits_of(c.normal.z),
                      bits_of(c.at.x),       bits_of(c.at.y)};
        vertices.push_back(
            known.emplace(key, static_cast<std::uint32_t>(known.size())).first->second);
    }
    return vertices;
}

/// What one triangle contributes.
struct Chart {
    glm::dvec3 tangent{0, 0,
                       0}; ///< dP/dx, of any length; zero where the triangle counts for nothing
    bool mirrored = false;

    bool counts() const { return tangent != glm::dvec3(0); }
};

Chart chart_of(const TexturedCorner* corner) {
    const glm::dvec3 e1 = glm::dvec3(corner[1].position) - glm::dvec3(corner[0].position);
    const glm::dvec3 e2 = glm::dvec3(corner[2].position) - glm::dvec3(corner[0].position);
    const glm::dvec2 t1 = glm::dvec2(corner[1].at) - glm::dvec2(corner[0].at);
    const glm::dvec2 t2 = glm::dvec2(corner[2].at) - glm::dvec2(corner[0].at);
    // y = 1 - v flips the sign of every difference of v.
    const double area = t2.x * t1.y - t1.x * t2.y;
    if (area == 0 || glm::cross(e1, e2) == glm::dvec3(0)) return {};
    const glm::dvec3 along = t1.y * e2 - t2.y * e1;
    return {area > 0 ? along : -along, area < 0};
}

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
    return std::uint64_t{from} << 32U | to;
}

/// Unites the corners of triangles that share an edge. Each edge of a triangle has at most one
/// neighbour: the first in order that runs it the other way and has none yet.
void unite_across_edges(const std::vector<std::uint32_t>& vertices,
                        const std::vector<Chart>& charts, UnionFind& groups) {
    struct Edges {
        std::vector<std::uint32_t> starts; ///< corners at which they start
        std::size_t taken = 0;             ///< so many of them have a neighbour
    };
    std::unordered_map<std::uint64_t, Edges> waiting;
    const auto corners = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t from = 0; from < corners; ++from) {
        const Chart& chart = charts[from / 3];
        if (!chart.counts()) continue;
        const std::uint32_t to = from % 3 == 2 ? from - 2 : from + 1;
        const auto opposite = waiting.find(edge_key(vertices[to], vertices[from]));
        if (opposite == waiting.end() || opposite->second.taken == opposite->second.starts.size()) {
            waiting[edge_key(vertices[from], vertices[to])].starts.push_back(from);
            continue;
        }
        const std::uint32_t other = opposite->second.starts[opposite->second.taken++];
        if (charts[other / 3].mirrored != chart.mirrored) continue;
        groups.unite(to, other);
        groups.unite(from, other % 3 == 2 ? other - 2 : other + 1);
    }
}

/// A vector projected into the plane at right angles to `normal`, normalised; zero where nothing is
/// left of it.
glm::dvec3 laid_across(const glm::dvec3& normal, const glm::dvec3& vector) {
    const glm::dvec3 across = vector - normal * glm::dot(normal, vector);
    const double length = glm::length(across);
    return length > 0 ? across / length : glm::dvec3(0);
}

/// What a corner adds to its group's tangent: its triangle's tangent, weighted by the angle there.
glm::dvec3 share_of(const std::vector<TexturedCorner>& corners, const Chart& chart,
                    std::uint32_t corner) {
    const std::uint32_t first = corner / 3 * 3;
    const glm::dvec3 here(corners[corner].position);
    const glm::dvec3 normal(corners[corner].normal);
    const auto edge_to = [&](std::uint32_t turn) {
        const glm::dvec3 there(corners[first + (corner - first + turn) % 3].position);
        return laid_across(normal, there - here);
    };
    const double angle = std::acos(std::clamp(glm::dot(edge_to(1), edge_to(2)), -1.0, 1.0));
    return angle * laid_across(normal, chart.tangent);
}

} // namespace

glm::dvec3 any_tangent(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2);
    glm::dvec3 along(0);
    along[axis] = 1;
    return glm::normalize(along - normal * normal[axis]);
}

std::vector<glm::vec4> make_tangents(const std::vector<TexturedCorner>& corners) {
    const auto count = static_cast<std::uint32_t>(corners.size());
    const std::vector<std::uint32_t> vertices = weld(corners);
    std::vector<Chart> charts;
    for (std::size_t i = 0; i < corners.size(); i += 3) charts.push_back(chart_of(&corners[i]));
    UnionFind groups(corners.size());
    unite_across_edges(vertices, charts, groups);

    std::vector<glm::dvec3> sums(corners.size(), glm::dvec3(0));
    std::vector<std::uint32_t> first_at(corners.size(), count); // of a vertex: a corner that counts
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!charts[i / 3].counts()) continue;
        sums[groups.find(i)] += share_of(corners, charts[i / 3], i);
        first_at[vertices[i]] = std::min(first_at[vertices[i]], i);
    }
    std::vector<glm::vec4> tangents;
    tangents.reserve(corners.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool counts = charts[i / 3].counts();
        const std::uint32_t source = counts ? i : first_at[vertices[i]];
        const glm::dvec3 sum = source < count ? sums[groups.find(source)] : glm::dvec3(0);
        const glm::dvec3 tangent =
            sum != glm::dvec3(0) ? glm::normalize(sum) : any_tangent(corners[i].normal);
        float w = source < count && charts[source / 3].mirrored ? -1.0F : 1.0F;
        if (!counts && i % 3 != 0) w = tangents[i - i % 3].w;
        tangents.emplace_back(glm::vec3(tangent), w);
    }
    return tangents;
}

} // namespace shadowproof
