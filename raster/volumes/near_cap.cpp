#include "raster/volumes/near_cap.h"

#include "raster/passes/passes.h"
#include "scenes/mesh/topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

namespace shadowproof {

namespace {

constexpr std::uint32_t unmade = 0xffffffffU;

/// Cuts faces whose corners are nodes: node i < n is position i, node i + n its end at infinity,
/// and later nodes are ends along the directions of a split.
class Cutter {
public:
    Cutter(const Scene& scene, const SplitFarEnds& split)
        : scene_(scene), split_(split), count_(static_cast<std::uint32_t>(scene.positions.size())),
          light_(homogeneous(chosen_light(scene))),
          point_of_node_(2 * std::size_t{count_} + split.directions.size(), unmade) {}

    std::uint32_t at_infinity(std::uint32_t node) const {
        const std::uint32_t* own = split_.of(node);
        return own != nullptr ? along(*own) : node + count_;
    }
    std::uint32_t along(std::uint32_t direction) const { return 2 * count_ + direction; }

    /// The side over the edge from a to b of a triangle that faces the light.
    std::vector<std::uint32_t> side(std::uint32_t a, std::uint32_t b) const {
        std::vector<std::uint32_t> nodes{b, a, at_infinity(a)};
        if (const std::uint32_t* across = split_.across(a, b)) nodes.push_back(along(*across));
        nodes.push_back(at_infinity(b));
        return nodes;
    }

    /// A triangle's far end, wound in reverse.
    std::vector<std::vector<std::uint32_t>> far_end(std::uint32_t triangle,
                                                    const glm::uvec3& corners) const {
        const auto end = [&](std::uint32_t node) { return at_infinity(node); };
        if (split_.behind(triangle) == nullptr)
            return {{end(corners.z), end(corners.y), end(corners.x)}};
        std::vector<std::vector<std::uint32_t>> parts;
        for (const glm::uvec3& part :
             far_fan(split_, triangle, corners, end,
                     [&](std::uint32_t direction) { return along(direction); }))
            parts.push_back({part.z, part.y, part.x});
        return parts;
    }

    /// The point of the near plane that the eye looks at.
    std::uint32_t middle() {
        if (middle_ == unmade) middle_ = add({0, 0, -scene_.camera.near, 1});
        return middle_;
    }

    /// The part of a face beyond the near plane, as points in order, and the segment in which the
    /// plane cuts it: from where the face's outline returns to where it left.
    struct Part {
        std::vector<std::uint32_t> points;
        bool is_cut = false;
        std::pair<std::uint32_t, std::uint32_t> segment;
    };
    Part cut(std::span<const std::uint32_t> nodes) {
        Part part;
        std::uint32_t left = 0;
        std::uint32_t back = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const std::uint32_t node = nodes[i];
            const std::uint32_t next = nodes[(i + 1) % nodes.size()];
            const bool inside = beyond(node) >= 0;
            const bool next_inside = beyond(next) >= 0;
            if (inside) part.points.push_back(point_of(node));
            if (inside == next_inside) continue;
            const std::uint32_t point = point_between(node, next);
            part.points.push_back(point);
            part.is_cut = true;
            (inside ? left : back) = point;
        }
        part.segment = {back, left};
        return part;
    }

    std::vector<glm::vec4> take_points() { return std::move(points_); }

private:
    const Scene& scene_;
    const SplitFarEnds& split_;
    std::uint32_t count_;
    std::uint32_t middle_ = unmade;
    glm::dvec4 light_;
    std::vector<std::uint32_t> point_of_node_;
    std::unordered_map<std::uint64_t, std::uint32_t> point_of_edge_;
    std::vector<glm::vec4> points_;

    /// In view space, (x, y, z, w).
    glm::dvec4 place(std::uint32_t node) const {
        const Camera& camera = scene_.camera;
        const bool infinite = node >= count_;
        glm::dvec3 from;
        if (node >= 2 * count_) {
            from = split_.directions[node - 2 * count_];
        } else {
            const glm::dvec3 position = scene_.positions[infinite ? node - count_ : node];
            from = infinite ? light_.w * position - glm::dvec3(light_) : position - camera.eye;
        }
        return {glm::dot(camera.right, from), glm::dot(camera.up, from),
                -glm::dot(camera.forward, from), infinite ? w_at_infinity(camera) : 1};
    }

    /// Linear in place(node), positive beyond the near plane.
    double beyond(std::uint32_t node) const {
        const glm::dvec4 at = place(node);
        return -at.z - scene_.camera.near * at.w;
    }

    std::uint32_t add(const glm::dvec4& point) {
        points_.emplace_back(point);
        return static_cast<std::uint32_t>(points_.size() - 1);
    }

    std::uint32_t point_of(std::uint32_t node) {
        std::uint32_t& point = point_of_node_[node];
        if (point == unmade) point = add(place(node));
        return point;
    }

    std::uint32_t point_between(std::uint32_t a, std::uint32_t b) {
        if (a > b) std::swap(a, b); // the same bits from both sides
        const auto [entry, is_new] = point_of_edge_.try_emplace(std::uint64_t{a} << 32U | b, 0);
        if (is_new) entry->second = add(meeting_point(a, b));
        return entry->second;
    }

    /// Where the line through two nodes meets the near plane; the coefficients have one sign, so
    /// that the point lies between them.
    glm::dvec4 meeting_point(std::uint32_t a, std::uint32_t b) const {
        const double of_a = std::abs(beyond(a));
        const double of_b = std::abs(beyond(b));
        glm::dvec4 point = place(a) * of_b + place(b) * of_a;
        if (point.w > 0) {
            point /= point.w;
            point.z = -scene_.camera.near;
        } else {
            const double size = std::max(std::abs(point.x), std::abs(point.y));
            if (size > 0) point /= size;
            point.z = 0;
        }
        return point;
    }
};

void append_fan(const std::vector<std::uint32_t>& points, std::vector<glm::uvec3>& triangles) {
    for (std::size_t i = 2; i < points.size(); ++i)
        triangles.emplace_back(points[0], points[i - 1], points[i]);
}

/// The loop that directed segments form: at most one begins at each point. As each node lies on one
/// side of the plane for all faces, they form a closed loop; if they did not, there would be no
/// cap.
std::vector<std::uint32_t>
loop_of(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& segments) {
    std::vector<std::uint32_t> loop;
    if (segments.empty()) return loop;
    std::uint32_t at = segments.front().first;
    do {
        loop.push_back(at);
        const auto next = std::find_if(segments.begin(), segments.end(),
                                       [&](const auto& segment) { return segment.first == at; });
        if (next == segments.end()) return {};
        at = next->second;
    } while (at != loop.front() && loop.size() <= segments.size());
    return loop;
}

} // namespace

NearCut cut_at_near_plane(const Scene& scene, std::span<const std::uint32_t> welded,
                          std::span<const std::uint32_t> facing, const SplitFarEnds& split) {
    Cutter cutter(scene, split);
    NearCut cut;
    for (const auto& [a, b, surplus] : boundary(scene, welded, facing)) {
        const Cutter::Part part = cutter.cut(cutter.side(a, b));
        for (int i = 0; i < surplus; ++i) append_fan(part.points, cut.sides);
    }
    for (const std::uint32_t triangle : facing) {
        std::array<std::uint32_t, 3> near{};
        for (int k = 0; k < 3; ++k)
            near[static_cast<std::size_t>(k)] = welded[scene.triangles[triangle][k]];
        std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;
        const auto add_segment = [&](std::span<const std::uint32_t> face) {
            const Cutter::Part part = cutter.cut(face);
            // The cap runs along it the other way.
            if (part.is_cut) segments.emplace_back(part.segment);
        };
        add_segment(near);
        for (const std::vector<std::uint32_t>& part :
             cutter.far_end(triangle, {near[0], near[1], near[2]}))
            add_segment(part);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = near[k];
            const std::uint32_t b = near[(k + 1) % 3];
            add_segment(cutter.side(a, b));
        }
        if (split.behind(triangle) == nullptr) {
            append_fan(loop_of(segments), cut.caps);
            continue;
        }
        for (const auto& [from, to] : segments) cut.caps.emplace_back(cutter.middle(), from, to);
    }
    cut.points = cutter.take_points();
    return cut;
}

double ledge_near(const DepthModel& model) {
    const double near = model.near;
    const double far = model.far;
    if (model.parallel) return (near - ledge * far) / (1 - ledge);
    return (1 - ledge) * far * near / (far - ledge * near);
}

} // namespace shadowproof
