#include "compare/stencil/figures/drawn_faces.h"

#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/split_far_ends.h"
#include "scenes/mesh/topology.h"
#include "scenes/mesh/touching_light.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

namespace shadowproof {

namespace {

enum class Facing : std::uint8_t { no, perhaps, yes };

/// Casters that are counted alike, each with a volume of its own.
struct Part {
    Counting::Caster caster;
    bool is_flipped = false; ///< by a technique whose other volumes shaders may make
    bool by_shaders = false;
    std::vector<std::uint32_t> triangles;
};

std::vector<Part> parts_of(const Scene& casters, const Counting& counting, const VolumeFaces& drawn,
                           const std::vector<std::uint8_t>& flipped) {
    const std::vector<std::uint8_t> casts = casting_triangles(casters);
    // Where a caster touches the light, shaders make no volume.
    const bool shaders_may = drawn.by_shaders && triangles_touching_light(casters).empty();
    std::vector<Part> parts;
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const Counting::Caster caster = counting.caster(triangle);
        const bool is_flipped =
            drawn.by_shaders && triangle < flipped.size() && flipped[triangle] != 0;
        auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) {
            return p.caster == caster && p.is_flipped == is_flipped;
        });
        if (part == parts.end())
            part = parts.insert(part, {caster, is_flipped, shaders_may && !is_flipped, {}});
        part->triangles.push_back(triangle);
    }
    return parts;
}

// Differences, products and sums of a determinant of three edges: 3 + 2 + 2 roundings of terms of
// the size of the product of their lengths, of which it has six; 8 for each is more than that.
bool may_round_to_either_side(const Scene& casters, std::uint32_t triangle,
                              const glm::dvec4& light) {
    const glm::dvec3 a = corner(casters, triangle, 0);
    const glm::dvec3 ab = corner(casters, triangle, 1) - a;
    const glm::dvec3 ac = corner(casters, triangle, 2) - a;
    const glm::dvec3 al = glm::dvec3(light) - light.w * a;
    const auto size = [](const glm::dvec3& edge) { return glm::length(edge); };
    // Whichever corner is the first, its edges are no longer than the sum of these.
    const double edges = size(ab) + size(ac);
    const double terms = edges * edges * (size(al) + light.w * edges);
    return std::abs(glm::dot(glm::cross(ab, ac), al)) <= 6 * 8 * double_roundoff * terms;
}

Facing facing_of(const Scene& casters, std::uint32_t triangle, bool by_shaders) {
    const glm::dvec4 light = homogeneous(chosen_light(casters));
    if (by_shaders && may_round_to_either_side(casters, triangle, light)) return Facing::perhaps;
    return side(casters, triangle, light) > 0 ? Facing::yes : Facing::no;
}

/// Collects the faces of one part after the other.
class Collector {
public:
    /// `is_finite`: the volumes are.
    Collector(const Scene& casters, const VolumeFaces& drawn, const SplitFarEnds& split,
              bool is_finite, DrawnFaces& found)
        : casters_(casters), drawn_(drawn), split_(split), found_(found),
          welded_(weld_by_position(casters.positions)),
          far_end_(static_cast<std::uint32_t>(casters.positions.size())),
          has_dark_caps_(is_finite || !casters.camera.is_orthographic()),
          facing_(casters.triangles.size(), Facing::no) {}

    void add(const Part& part) {
        for (const std::uint32_t triangle : part.triangles)
            facing_[triangle] = facing_of(casters_, triangle, part.by_shaders);
        add_caps(part);
        if (part.by_shaders || drawn_.sides == VolumeFaces::Sides::half_edges)
            add_sides_by_half_edges(part, !part.by_shaders && drawn_.by_shaders);
        else if (drawn_.sides == VolumeFaces::Sides::all)
            add_all_sides(part);
        else
            add_sides_by_surplus(part);
        for (const std::uint32_t triangle : part.triangles)
            if (drawn_.near_plane != NearPlane::lost && facing_[triangle] != Facing::no)
                add_near_layers(triangle);
    }

private:
    const Scene& casters_;
    const VolumeFaces& drawn_;
    const SplitFarEnds& split_;
    DrawnFaces& found_;
    std::vector<std::uint32_t> welded_;
    std::uint32_t far_end_;
    bool has_dark_caps_; ///< at infinity, parallel lines of sight see none
    std::vector<Facing> facing_;

    std::uint32_t along(std::uint32_t direction) const { return 2 * far_end_ + direction; }
    std::uint32_t far_end_of(std::uint32_t position) const {
        const std::uint32_t* own = split_.of(position);
        return own != nullptr ? along(*own) : position + far_end_;
    }

    bool is_hidden(const Part& part, std::uint32_t triangle) const {
        return part.caster.test == Counting::Test::depth_pass &&
               triangle < drawn_.hidden_caps.size() && drawn_.hidden_caps[triangle] != 0;
    }

    void add_caps(const Part& part) {
        const std::vector<std::uint32_t>& triangles = part.triangles;
        std::uint32_t copies = 1;
        for (std::size_t i = 0; i < triangles.size(); i += copies) {
            const std::uint32_t triangle = triangles[i];
            copies = 1;
            while (i + copies < triangles.size() && triangles[i + copies] == triangle + copies &&
                   have_same_caps(part, triangle, triangle + copies))
                ++copies;
            if (facing_[triangle] == Facing::no) continue;
            const bool certain = facing_[triangle] == Facing::yes;
            const glm::uvec3 corners = casters_.triangles[triangle];
            if (part.caster.light_cap && !is_hidden(part, triangle))
                found_.faces.push_back({.part = DrawnFace::Part::light_cap,
                                        .certain = certain,
                                        .triangle = triangle,
                                        .corners = corners,
                                        .other_corner = {},
                                        .copies = copies});
            if (part.caster.dark_cap && has_dark_caps_)
                add_dark_cap(triangle, corners, certain, copies);
        }
    }

    bool have_same_caps(const Part& part, std::uint32_t one, std::uint32_t other) const {
        return casters_.triangles[one] == casters_.triangles[other] &&
               facing_[one] == facing_[other] && is_hidden(part, one) == is_hidden(part, other) &&
               split_.behind(one) == nullptr && split_.behind(other) == nullptr;
    }

    /// Of a volume with a split far end, a triangle for each of its faces that the plane cuts: its
    /// light cap, its sides and what its dark cap is split into.
    void add_near_layers(std::uint32_t triangle) {
        if (split_.behind(triangle) == nullptr)
            return found_.near_layers.push_back({triangle, false});
        const glm::uvec3 corners = casters_.triangles[triangle];
        int faces = 1 + 3 + 3;
        for (int k = 0; k < 3; ++k)
            if (split_.across(corners[k], corners[(k + 1) % 3]) != nullptr) ++faces;
        for (int i = 0; i < faces; ++i) found_.near_layers.push_back({triangle, true});
    }

    void add_dark_cap(std::uint32_t triangle, const glm::uvec3& corners, bool certain,
                      std::uint32_t copies) {
        const auto add = [&](const glm::uvec3& cap) {
            found_.faces.push_back({.part = DrawnFace::Part::dark_cap,
                                    .certain = certain,
                                    .triangle = triangle,
                                    .corners = cap,
                                    .other_corner = {},
                                    .inward = true,
                                    .copies = copies});
        };
        const auto far_end = [&](std::uint32_t position) { return far_end_of(position); };
        if (split_.behind(triangle) == nullptr)
            return add({far_end(corners.x), far_end(corners.y), far_end(corners.z)});
        const auto extra = [&](std::uint32_t direction) { return along(direction); };
        for (const glm::uvec3& cap : far_fan(split_, triangle, corners, far_end, extra)) add(cap);
    }

    /// The two triangles of a side, parted from the earlier position's far end to the later one. A
    /// triangle that faces the light has the edge from a to b.
    void add_side(std::uint32_t a, std::uint32_t b, std::uint32_t triangle, bool certain = true,
                  std::uint32_t copies = 1) {
        const std::uint32_t low = std::min(a, b);
        const std::uint32_t high = std::max(a, b);
        const bool inward = high == a;
        constexpr auto part = DrawnFace::Part::side;
        const std::uint32_t low_end = far_end_of(low);
        const std::uint32_t high_end = far_end_of(high);
        if (const std::uint32_t* across = split_.across(low, high)) {
            const std::uint32_t middle = along(*across);
            for (const glm::uvec3& face :
                 {glm::uvec3{middle, high, low}, {middle, low, low_end}, {middle, high_end, high}})
                found_.faces.push_back({part, certain, triangle, face, {}, false, inward, copies});
            return;
        }
        found_.faces.push_back(
            {part, certain, triangle, {high, low, low_end}, high_end, true, inward, copies});
        found_.faces.push_back(
            {part, certain, triangle, {low_end, high_end, high}, low, false, inward, copies});
    }

    void add_all_sides(const Part& part) {
        for (const std::uint32_t triangle : part.triangles) {
            if (facing_[triangle] == Facing::no) continue;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = welded_[casters_.triangles[triangle][k]];
                const std::uint32_t b = welded_[casters_.triangles[triangle][(k + 1) % 3]];
                if (a != b) add_side(a, b, triangle);
            }
        }
    }

    /// As often as more triangles run an edge one way than the other.
    void add_sides_by_surplus(const Part& part) {
        struct Use {
            std::uint32_t low, high, triangle;
            int runs; ///< +1: from low to high
        };
        std::vector<Use> uses;
        for (const std::uint32_t triangle : part.triangles)
            for (int k = 0; k < 3 && facing_[triangle] != Facing::no; ++k) {
                const std::uint32_t a = welded_[casters_.triangles[triangle][k]];
                const std::uint32_t b = welded_[casters_.triangles[triangle][(k + 1) % 3]];
                uses.push_back({std::min(a, b), std::max(a, b), triangle, a < b ? 1 : -1});
            }
        const auto edge_of = [](const Use& use) { return std::tie(use.low, use.high); };
        std::sort(uses.begin(), uses.end(), [&](const Use& one, const Use& other) {
            return std::tie(one.low, one.high, one.triangle) <
                   std::tie(other.low, other.high, other.triangle);
        });
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            int surplus = 0;
            for (; end < uses.size() && edge_of(uses[end]) == edge_of(uses[begin]); ++end)
                surplus += uses[end].runs;
            const auto [low, high, triangle, runs] = uses[begin];
            const auto copies = static_cast<std::uint32_t>(std::abs(surplus));
            if (surplus > 0) add_side(low, high, triangle, true, copies);
            if (surplus < 0) add_side(high, low, triangle, true, copies);
        }
    }

    /// `surplus_after_all`: these few are the CPU's, beside shaders.
    void add_sides_by_half_edges(const Part& part, bool surplus_after_all) {
        if (surplus_after_all) return add_sides_by_surplus(part);
        const HalfEdgeMesh mesh = connect(casters_, welded_, part.triangles);
        for (const HalfEdge& half_edge : mesh.half_edges) {
            const Facing own = facing_[half_edge.triangle];
            const Facing other = half_edge.twin == no_half_edge
                                     ? Facing::no
                                     : facing_[mesh.half_edges[half_edge.twin].triangle];
            if (own == Facing::no || other == Facing::yes) continue;
            add_side(half_edge.origin, mesh.half_edges[half_edge.next].origin, half_edge.triangle,
                     own == Facing::yes && other == Facing::no);
        }
    }
};

} // namespace

DrawnFaces drawn_faces(const Volumes& volumes, const Counting& counting, const VolumeFaces& drawn) {
    const Scene& casters = volumes.drawn_casters();
    const bool is_finite = std::isfinite(counting.extrusion);
    const SplitFarEnds split = is_finite ? SplitFarEnds{} : split_far_ends(casters);
    DrawnFaces found;
    found.far_points = points_towards_infinity(casters, split);
    Collector collector(casters, drawn, split, is_finite, found);
    for (const Part& part : parts_of(casters, counting, drawn, volumes.flipped()))
        collector.add(part);
    return found;
}

} // namespace shadowproof
