#include "reference/trace/arbiters.h"

#include "reference/exact/norms.h"
#include "reference/trace/plane_edges.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double u = double_roundoff;

} // namespace

/// Collects the signs of one query about one triangle. A sign that says "out" outweighs a tie; a
/// tie that decides nothing is not counted as one.
class Signs {
public:
    /// False once the answer is no.
    bool at_least_zero(const Decision& decision, int orientation) {
        return take(decision, decision.sign * orientation >= 0);
    }
    bool above_zero(const Decision& decision, int orientation) {
        return take(decision, decision.sign * orientation > 0);
    }
    std::uint64_t exact_decisions() const { return exact_; }
    Exactness exactness() const { return exactness_; }

private:
    Exactness exactness_ = Exactness::filtered;
    std::uint64_t exact_ = 0;

    bool take(const Decision& decision, bool holds) {
        if (decision.exactness != Exactness::filtered) ++exact_;
        exactness_ = std::max(exactness_, decision.exactness);
        return holds;
    }
};

void NearestArbiter::decide(RayPacket& packet, int lane, std::uint32_t triangle) {
    Signs signs;
    const bool nearer = is_nearer(packet, lane, triangle, signs);
    rays_.exact_decisions += signs.exact_decisions();
    Seen& seen = seen_[static_cast<std::size_t>(lane)];
    // A miss that was decided exactly is recorded too; but a tie counts only where the triangle
    // is met.
    seen.exactness = std::max(seen.exactness, met_ ? signs.exactness()
                                                   : std::min(signs.exactness(), Exactness::exact));
    if (!nearer) return;
    packet.hit[static_cast<std::size_t>(lane)] = triangle;
    // Depth in double, widened to certain floats.
    const EyeRay ray = rays_.ray(lane);
    const Corners t = rays_.triangle(triangle);
    raise_to_depth(packet, lane, ray, t);
}

bool NearestArbiter::is_nearer(const RayPacket& packet, int lane, std::uint32_t triangle,
                               Signs& signs) {
    const EyeRay ray = rays_.ray(lane);
    const Corners t = rays_.triangle(triangle);
    const int orientation = rays_.state->from_eye.side[triangle];
    const std::array<glm::dvec3, 3> corners{t.a, t.b, t.c};
    std::array<bool, 3> through{}; // the lines of which edges
    met_ = false;
    // The edges' planes of an oriented triangle add up to its normal, so that no ray away from
    // it has all three signs right.
    for (std::size_t k = 0; k < 3; ++k) {
        const Decision side = edge(ray, lane, corners[k], corners[(k + 1) % 3]);
        if (!signs.at_least_zero(side, orientation)) return false;
        through[k] = side.sign == 0;
    }
    // The eye is not in the triangle's plane, so the planes of two edges meet in a line.
    for (std::size_t k = 0; k < 3; ++k)
        if (through[k] && through[(k + 1) % 3])
            vertex_[static_cast<std::size_t>(lane)] = corners[(k + 1) % 3];

    const std::uint32_t best = packet.hit[static_cast<std::size_t>(lane)];
    if (best != no_triangle && meet_there(lane, corners, through, best)) {
        signs.at_least_zero({0, Exactness::degenerate}, 1);
        met_ = true;
        return triangle < best;
    }
    met_ = within_planes(ray, t, signs);
    if (!met_) return false;
    if (best == no_triangle) return true;
    const Decision order = rays_.predicates.depth_order(ray, t, rays_.triangle(best));
    signs.at_least_zero(order, 1);
    return order.sign < 0 || (order.sign == 0 && triangle < best);
}

Decision NearestArbiter::edge(const EyeRay& ray, int lane, const glm::dvec3& a,
                              const glm::dvec3& b) const {
    const std::optional<glm::dvec3>& vertex = vertex_[static_cast<std::size_t>(lane)];
    if (vertex && (*vertex == a || *vertex == b)) return {0, Exactness::degenerate};
    return rays_.predicates.edge(ray, a, b);
}

bool NearestArbiter::meet_there(int lane, const std::array<glm::dvec3, 3>& corners,
                                const std::array<bool, 3>& through, std::uint32_t best) const {
    const Corners other = rays_.triangle(best);
    const auto shares = [&](const glm::dvec3& p) {
        return p == other.a || p == other.b || p == other.c;
    };
    const std::optional<glm::dvec3>& vertex = vertex_[static_cast<std::size_t>(lane)];
    if (vertex && shares(*vertex) && std::ranges::count(corners, *vertex) > 0) return true;
    for (std::size_t k = 0; k < 3; ++k)
        if (through[k] && shares(corners[k]) && shares(corners[(k + 1) % 3])) return true;
    return false;
}

bool NearestArbiter::within_planes(const EyeRay& ray, const Corners& t, Signs& signs) const {
    const Predicates& predicates = rays_.predicates;
    return signs.at_least_zero(predicates.depth_against(ray, t, range_.near), 1) &&
           (std::isinf(range_.far) ||
            signs.at_least_zero(predicates.depth_against(ray, t, range_.far), -1));
}

void NearestArbiter::raise_to_depth(RayPacket& packet, int lane, const EyeRay& ray,
                                    const Corners& t) const {
    const PlaneEdges edges(t);
    const glm::dvec3 normal = glm::cross(edges.ab, edges.ac);
    const glm::dvec3 to_plane = edges.a - ray.eye;
    // As in view.cpp: 8 u l^2 per component, 50 u m l^2 for the dot product.
    const double numerator = glm::dot(to_plane, normal);
    const double numerator_error = 50 * u * largest(to_plane) * edges.product;
    const double denominator = glm::dot(ray.direction, normal);
    const double denominator_error = 50 * u * largest(ray.direction) * edges.product;
    const double scale = rays_.state->from_eye.scale;
    // The plane is too near the eye to tell: all further candidates must be compared exactly.
    if (!(std::abs(numerator) > 4 * numerator_error)) {
        packet.lower_hi[static_cast<std::size_t>(lane)] = std::numeric_limits<float>::infinity();
        return;
    }
    // 1/s = denominator / (numerator scale). The numerator may be smaller by a quarter, which
    // makes its relative error and the denominator's share up to 4/3 as large: 1.5 covers that
    // and second order, 4 u the roundings.
    const double inverse = denominator / (numerator * scale);
    const double error = std::abs(inverse) * (1.5 * numerator_error / std::abs(numerator) + 4 * u) +
                         1.5 * denominator_error / std::abs(numerator * scale);
    raise_lower_limit(packet, lane, std::max(float_below(inverse - error), 0.0F),
                      float_above(inverse + error));
}

void AnyArbiter::decide(RayPacket& packet, int lane, std::uint32_t triangle) {
    const auto l = static_cast<std::size_t>(lane);
    Signs signs;
    const RayPoint point{.kind = RayPoint::Kind::surface,
                         .surface = rays_.triangle(seen_[l].triangle)};
    const bool blocked = is_between(rays_.ray(lane), point, triangle, signs);
    rays_.exact_decisions += signs.exact_decisions();
    lighting_[l].exactness =
        std::max(lighting_[l].exactness,
                 touched_ ? signs.exactness() : std::min(signs.exactness(), Exactness::exact));
    if (!blocked) return;
    packet.hit[l] = triangle;
    finish_lane(packet, lane);
}

bool AnyArbiter::is_between(const EyeRay& ray, const RayPoint& q, std::uint32_t triangle,
                            Signs& signs) {
    const Predicates& predicates = rays_.predicates;
    const Corners t = rays_.triangle(triangle);
    const int orientation = rays_.state->from_light.side[triangle];
    const Decision beyond = predicates.side_of_point(ray, q, t);
    touched_ = signs.at_least_zero(beyond, orientation) &&
               signs.at_least_zero(predicates.shadow_edge(ray, q, t.a, t.b), orientation) &&
               signs.at_least_zero(predicates.shadow_edge(ray, q, t.b, t.c), orientation) &&
               signs.at_least_zero(predicates.shadow_edge(ray, q, t.c, t.a), orientation);
    return touched_ && beyond.sign != 0;
}

void CountArbiter::decide(RayPacket& packet, int lane, std::uint32_t triangle) {
    const auto l = static_cast<std::size_t>(lane);
    const EyeRay ray = rays_.ray(lane);
    const RayPoint q = exact_point(points_[l]);
    const Predicates& predicates = rays_.predicates;
    const Corners t = rays_.triangle(triangle);
    const int orientation = rays_.state->from_light.side[triangle];
    Signs signs;
    const bool between =
        signs.above_zero(behind(ray, q, t), orientation) &&
        signs.above_zero(predicates.shadow_edge_untied(ray, q, t.a, t.b), orientation) &&
        signs.above_zero(predicates.shadow_edge_untied(ray, q, t.b, t.c), orientation) &&
        signs.above_zero(predicates.shadow_edge_untied(ray, q, t.c, t.a), orientation);
    rays_.exact_decisions += signs.exact_decisions();
    if (between) packet.crossed[l] += records_.copies(triangle);
}

Decision CountArbiter::behind(const EyeRay& ray, const RayPoint& q, const Corners& t) const {
    const Predicates& predicates = rays_.predicates;
    const bool at_eye = q.kind == RayPoint::Kind::depth && q.depth == 0;
    return at_eye ? predicates.side_of_point_untied(ray, q, t)
                  : predicates.side_of_point(ray, q, t);
}

RayPoint CountArbiter::exact_point(const Prober::Point& point) const {
    if (point.kind != RayPoint::Kind::surface) return {.kind = point.kind, .depth = point.depth};
    return {.kind = point.kind, .surface = rays_.triangle(point.skip)};
}

} // namespace shadowproof
