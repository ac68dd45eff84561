#include "raster/near_cap.h"

#include "scenes/topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

namespace shadowproof {

namespace {

/// Cuts faces whose corners are nodes: node i < n is position i, node i + n its end at infinity.
class Cutter {
public:
    explicit Cutter(const Scene& scene)
        : scene_(scene), count_(static_cast<std::uint32_t>(scene.positions.size())),
          light_(homogeneous(chosen_light(scene))),
          point_of_node_(2 * std::size_t{count_}, unmade) {}

    std::uint32_t at_infinity(std::uint32_t node) const { return node + count_; }

    /// A face's part beyond the near plane, as points in order, and the segment in which the plane
    /// cuts it: from where the face's outline comes back to where it left.
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
    static constexpr std::uint32_t unmade = 0xffffffffU;

    const Scene& scene_;
    std::uint32_t count_;
    glm::dvec4 light_;
    std::vector<std::uint32_t> point_of_node_;
    std::unordered_map<std::uint64_t, std::uint32_t> point_of_edge_;
    std::vector<glm::vec4> points_;

    /// In view space, (x, y, z, w).
    glm::dvec4 place(std::uint32_t node) const {
        const Camera& camera = scene_.camera;
        const bool infinite = node >= count_;
        const glm::dvec3 position = scene_.positions[infinite ? node - count_ : node];
        const glm::dvec3 from =
            infinite ? light_.w * position - glm::dvec3(light_) : position - camera.eye;
        return {glm::dot(camera.right, from), glm::dot(camera.up, from),
                -glm::dot(camera.forward, from), infinite ? 0 : 1};
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

    /// Where the line through two nodes meets the near plane; coefficients of one sign, so that the
    /// point lies between them.
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
/// side of the plane for all faces, they close; if they did not, there would be no cap.
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
                          std::span<const std::uint32_t> facing) {
    Cutter cutter(scene);
    NearCut cut;
    for (const auto& [a, b, surplus] : boundary(scene, welded, facing)) {
        const std::array<std::uint32_t, 4> side{b, a, cutter.at_infinity(a), cutter.at_infinity(b)};
        const Cutter::Part part = cutter.cut(side);
        for (int i = 0; i < surplus; ++i) append_fan(part.points, cut.sides);
    }
    for (const std::uint32_t triangle : facing) {
        std::array<std::uint32_t, 3> near{};
        std::array<std::uint32_t, 3> far{};
        for (int k = 0; k < 3; ++k) {
            near[static_cast<std::size_t>(k)] = welded[scene.triangles[triangle][k]];
            far[static_cast<std::size_t>(2 - k)] =
                cutter.at_infinity(near[static_cast<std::size_t>(k)]);
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;
        const auto add_segment = [&](std::span<const std::uint32_t> face) {
            const Cutter::Part part = cutter.cut(face);
            // The cap runs along it the other way.
            if (part.is_cut) segments.emplace_back(part.segment);
        };
        add_segment(near);
        add_segment(far);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = near[k];
            const std::uint32_t b = near[(k + 1) % 3];
            add_segment(std::array{b, a, cutter.at_infinity(a), cutter.at_infinity(b)});
        }
        append_fan(loop_of(segments), cut.caps);
    }
    cut.points = cutter.take_points();
    return cut;
}

double ledge_near(double near, double far) {
    return (1 - ledge) * far * near / (far - ledge * near);
}

} // namespace shadowproof
