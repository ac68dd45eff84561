#include "reference/trace/arbiters.h"

#include "reference/exact/norms.h"
#include "reference/trace/parallel_sight.h"
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

/// A product with a triangle's normal, and how far it may be off.
struct Product {
    double value = 0;
    double error = 0;
};

/// Where a ray meets a plane: its depth is their quotient.
struct PlaneDepth {
    Product numerator;
    Product denominator;
};

/// As in view.cpp: 8 u l^2 per component of the normal, 50 u m l^2 for the dot product.
PlaneDepth plane_depth(const EyeRay& ray, const Corners& t) {
    const PlaneEdges edges(t);
    const glm::dvec3 normal = glm::cross(edges.ab, edges.ac);
    const auto times_normal = [&](const glm::dvec3& v) {
        return Product{glm::dot(v, normal), 50 * u * largest(v) * edges.product};
    };
    return {times_normal(edges.a - ray.start), times_normal(ray.direction)};
}

/// The place of a met triangle on a parallel line of sight: its height, within bounds.
std::pair<float, float> height(const PacketRays& rays, int lane, const Corners& t) {
    const auto [numerator, denominator] = plane_depth(rays.ray(lane), t);
    // The plane is too nearly parallel to tell.
    if (!(std::abs(denominator.value) > 4 * denominator.error))
        return {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
    // The denominator may be smaller by a quarter, which makes errors up to 4/3 as large: 1.5
    // covers that and second order, 4 u the roundings.
    const double depth = numerator.value / denominator.value;
    const double size = std::abs(denominator.value);
    const double error =
        std::abs(depth) * (1.5 * denominator.error / size + 4 * u) + 1.5 * numerator.error / size;
    const auto [low, high] =
        heights_at(*rays.state, (*rays.lines)[static_cast<std::size_t>(lane)], depth, error);
    return {float_below(low), float_above(high)};
}

/// The place of a met triangle in the view's scale: 1/s, within bounds.
std::pair<float, float> inverse_depth(const PacketRays& rays, int lane, const Corners& t) {
    const PlaneDepth depth = plane_depth(rays.ray(lane), t);
    const auto [numerator, numerator_error] = depth.numerator;
    const auto [denominator, denominator_error] = depth.denominator;
    const double scale = rays.state->from_eye.scale;
    // The plane is too near the eye to tell: it may be nearer than any.
    if (!(std::abs(numerator) > 4 * numerator_error))
        return {0.0F, std::numeric_limits<float>::infinity()};
    // 1/s = denominator / (numerator scale). The numerator may be smaller by a quarter, which
    // makes its relative error and the denominator's share up to 4/3 as large: 1.5 covers that
    // and second order, 4 u the roundings.
    const double inverse = denominator / (numerator * scale);
    const double error = std::abs(inverse) * (1.5 * numerator_error / std::abs(numerator) + 4 * u) +
                         1.5 * denominator_error / std::abs(numerator * scale);
    return {std::max(float_below(inverse - error), 0.0F), float_above(inverse + error)};
}

void NearestArbiter::decide(RayPacket& packet, int lane, std::uint32_t triangle, float hi) {
    ++rays_.undecided;
    std::optional<Candidate> candidate = met(lane, triangle);
    if (!candidate) return;
    const auto place = rays_.state->from_eye.parallel ? height : inverse_depth;
    const auto [lo, most] = place(rays_, lane, rays_.triangle(triangle));
    const float unit = packet.unit[static_cast<std::size_t>(lane)];
    // By the floats' own bound, too: what came later would have been left out by it.
    candidate->hi = std::min(most * unit, hi);
    add(packet, *candidate, lo * unit);
}

void NearestArbiter::compare(RayPacket& packet, int lane, std::uint32_t triangle, float lo,
                             float hi) {
    add(packet, {.lane = lane, .triangle = triangle, .hi = hi}, lo);
}

void NearestArbiter::add(RayPacket& packet, const Candidate& candidate, float lo) {
    float& best = packet.best_lo[static_cast<std::size_t>(candidate.lane)];
    best = std::max(best, lo);
    packet.best_raised = true;
    candidates_.push_back(candidate);
    if (candidates_.size() < many_) return;
    std::erase_if(candidates_, [&](const Candidate& c) {
        return c.hi < packet.best_lo[static_cast<std::size_t>(c.lane)];
    });
    many_ = std::max(many_, 2 * candidates_.size());
}

/// Nothing where the ray does not meet the triangle within the range.
std::optional<NearestArbiter::Candidate> NearestArbiter::met(int lane, std::uint32_t triangle) {
    const EyeRay ray = rays_.ray(lane);
    const Corners t = rays_.triangle(triangle);
    const int orientation = rays_.state->from_eye.side[triangle];
    const std::array<glm::dvec3, 3> corners{t.a, t.b, t.c};
    Candidate candidate{.lane = lane, .triangle = triangle};
    Signs signs;
    // The edges' planes of an oriented triangle add up to its normal, so that no ray away from
    // it has all three signs right.
    for (std::size_t k = 0; k < 3; ++k) {
        const Decision side = edge(ray, lane, corners[k], corners[(k + 1) % 3]);
        if (!signs.at_least_zero(side, orientation)) return std::nullopt;
        candidate.through[k] = side.sign == 0;
    }
    // The eye, or the direction to it, is not in the triangle's plane, so the planes of two edges
    // meet in a line.
    for (std::size_t k = 0; k < 3; ++k)
        if (candidate.through[k] && candidate.through[(k + 1) % 3]) {
            vertex_[static_cast<std::size_t>(lane)] = corners[(k + 1) % 3];
            at_vertex_ |= 1U << lane;
        }
    if (!within_planes(ray, t, signs) || !stands(ray, lane, triangle, signs)) return std::nullopt;
    candidate.exactness = signs.exactness();
    candidate.exact_decisions = signs.exact_decisions();
    return candidate;
}

/// Whether its mask, if it has one, leaves the triangle standing where the ray meets it.
bool NearestArbiter::stands(const EyeRay& ray, int lane, std::uint32_t triangle,
                            Signs& signs) const {
    const Tracer::State& state = *rays_.state;
    if (!state.has_mask(triangle)) return true;
    const MaskReading reading = rays_.leeway == nullptr
                                    ? MaskReading::exact
                                    : rays_.leeway->readings[static_cast<std::size_t>(lane)];
    if (reading == MaskReading::exact)
        return signs.at_least_zero(mask_on_ray(rays_.filters, ray, state.masked(triangle)), 1);
    return may_stand_on_ray(
        ray, state.masked(triangle),
        rays_.leeway->errors->at(triangle, (*rays_.lines)[static_cast<std::size_t>(lane)]),
        reading);
}

void NearestArbiter::settle(RayPacket& packet) {
    if (candidates_.empty()) return;
    // Of those that floats met, the hit is kept apart.
    std::uint32_t lanes = 0;
    for (const Candidate& candidate : candidates_) lanes |= 1U << candidate.lane;
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const auto l = static_cast<std::size_t>(lane);
        if (packet.hit[l] != no_triangle)
            candidates_.push_back(
                {.lane = lane, .triangle = packet.hit[l], .hi = packet.hit_hi[l]});
    }
    std::erase_if(candidates_, [&](const Candidate& c) {
        return c.hi < packet.best_lo[static_cast<std::size_t>(c.lane)];
    });
    std::ranges::sort(candidates_, [](const Candidate& a, const Candidate& b) {
        return a.lane != b.lane ? a.lane < b.lane : a.triangle < b.triangle;
    });
    const auto again = std::ranges::unique(candidates_, [](const Candidate& a, const Candidate& b) {
        return a.lane == b.lane && a.triangle == b.triangle;
    });
    candidates_.erase(again.begin(), again.end());
    for (auto first = candidates_.begin(); first != candidates_.end();) {
        const auto end = std::find_if(first, candidates_.end(),
                                      [&](const Candidate& c) { return c.lane != first->lane; });
        settle_lane(packet, std::span(first, end));
        first = end;
    }
}

/// `candidates`: in ascending order, at least one.
void NearestArbiter::settle_lane(RayPacket& packet, std::span<const Candidate> candidates) {
    const int lane = candidates.front().lane;
    Exactness& exactness = seen_.exactness[static_cast<std::size_t>(lane)];
    std::uint32_t best = no_triangle;
    Signs signs;
    for (const Candidate& candidate : candidates) {
        exactness = std::max(exactness, candidate.exactness);
        rays_.exact_decisions += candidate.exact_decisions;
        if (best == no_triangle) {
            best = candidate.triangle;
        } else if (meet_there(candidate, best)) {
            signs.at_least_zero({0, Exactness::degenerate}, 1);
        } else {
            const Decision order = rays_.predicates.depth_order(
                rays_.ray(lane), rays_.triangle(candidate.triangle), rays_.triangle(best));
            signs.at_least_zero(order, 1);
            if (order.sign < 0) best = candidate.triangle;
        }
    }
    exactness = std::max(exactness, signs.exactness());
    rays_.exact_decisions += signs.exact_decisions();
    packet.hit[static_cast<std::size_t>(lane)] = best;
}

Decision NearestArbiter::edge(const EyeRay& ray, int lane, const glm::dvec3& a,
                              const glm::dvec3& b) const {
    if (runs_through(lane, a) || runs_through(lane, b)) return {0, Exactness::degenerate};
    return rays_.predicates.edge(ray, a, b);
}

bool NearestArbiter::meet_there(const Candidate& candidate, std::uint32_t other_triangle) const {
    const Corners other = rays_.triangle(other_triangle);
    const Corners t = rays_.triangle(candidate.triangle);
    const std::array<glm::dvec3, 3> corners{t.a, t.b, t.c};
    const auto shares = [&](const glm::dvec3& p) {
        return p == other.a || p == other.b || p == other.c;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (runs_through(candidate.lane, corners[k]) && shares(corners[k])) return true;
        if (candidate.through[k] && shares(corners[k]) && shares(corners[(k + 1) % 3])) return true;
    }
    return false;
}

bool NearestArbiter::within_planes(const EyeRay& ray, const Corners& t, Signs& signs) const {
    const Predicates& predicates = rays_.predicates;
    return signs.at_least_zero(predicates.depth_against(ray, t, range_.near), 1) &&
           (std::isinf(range_.far) ||
            signs.at_least_zero(predicates.depth_against(ray, t, range_.far), -1));
}

namespace {

Occlusion occlusion_by(const PacketRays& rays, int lane, std::uint32_t seen,
                       std::uint32_t triangle) {
    const EyeRay ray = rays.ray(lane);
    const RayPoint q{.kind = RayPoint::Kind::surface, .surface = rays.triangle(seen)};
    const Predicates& predicates = rays.predicates;
    const Corners t = rays.triangle(triangle);
    const int orientation = rays.state->from_light.side[triangle];
    Signs signs;
    Occlusion found;
    const Decision beyond = predicates.side_of_point(ray, q, t);
    const auto stands = [&] {
        return !rays.state->has_mask(triangle) ||
               signs.at_least_zero(
                   mask_before_light(rays.filters, ray, q, rays.state->masked(triangle)), 1);
    };
    found.touched = signs.at_least_zero(beyond, orientation) &&
                    signs.at_least_zero(predicates.shadow_edge(ray, q, t.a, t.b), orientation) &&
                    signs.at_least_zero(predicates.shadow_edge(ray, q, t.b, t.c), orientation) &&
                    signs.at_least_zero(predicates.shadow_edge(ray, q, t.c, t.a), orientation) &&
                    stands();
    found.blocks = found.touched && beyond.sign != 0;
    found.exactness = signs.exactness();
    found.exact_decisions = signs.exact_decisions();
    return found;
}

} // namespace

void AnyArbiter::decide(RayPacket& /*packet*/, int lane, std::uint32_t triangle, float /*hi*/) {
    ++rays_.undecided;
    candidates_.push_back({lane, triangle});
    if (candidates_.size() >= many_) leave_out_what_is_beside();
}

void AnyArbiter::leave_out_what_is_beside() {
    Lanes<std::uint32_t> blocking{};
    blocking.fill(no_triangle);
    for (Candidate& candidate : candidates_) {
        const auto l = static_cast<std::size_t>(candidate.lane);
        if (candidate.triangle > blocking[l]) continue;
        if (!candidate.occlusion)
            candidate.occlusion =
                occlusion_by(rays_, candidate.lane, seen_.triangle[l], candidate.triangle);
        if (candidate.occlusion->blocks) blocking[l] = candidate.triangle;
    }
    std::erase_if(candidates_, [&](const Candidate& c) {
        return c.triangle > blocking[static_cast<std::size_t>(c.lane)] || !c.occlusion->touched;
    });
    many_ = std::max(many_, 2 * candidates_.size());
}

void AnyArbiter::settle(RayPacket& packet) {
    std::ranges::sort(candidates_, [](const Candidate& a, const Candidate& b) {
        return a.lane != b.lane ? a.lane < b.lane : a.triangle < b.triangle;
    });
    const auto again = std::ranges::unique(candidates_, [](const Candidate& a, const Candidate& b) {
        return a.lane == b.lane && a.triangle == b.triangle;
    });
    candidates_.erase(again.begin(), again.end());
    for (Candidate& candidate : candidates_) {
        const auto l = static_cast<std::size_t>(candidate.lane);
        if ((packet.active >> l & 1U) == 0) continue;
        if (!candidate.occlusion)
            candidate.occlusion =
                occlusion_by(rays_, candidate.lane, seen_.triangle[l], candidate.triangle);
        if (!candidate.occlusion->touched) continue;
        rays_.exact_decisions += candidate.occlusion->exact_decisions;
        lighting_.exactness[l] = std::max(lighting_.exactness[l], candidate.occlusion->exactness);
        if (!candidate.occlusion->blocks) continue;
        packet.hit[l] = candidate.triangle;
        packet.active &= ~(1U << l);
    }
}

void LowestArbiter::decide(RayPacket& packet, int lane, std::uint32_t triangle, float /*hi*/) {
    const auto l = static_cast<std::size_t>(lane);
    if (triangle < packet.hit[l] && occlusion_by(rays_, lane, seen_.triangle[l], triangle).blocks)
        packet.hit[l] = triangle;
}

void CountArbiter::decide(RayPacket& packet, int lane, std::uint32_t triangle, float /*hi*/) {
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
        signs.above_zero(predicates.shadow_edge_untied(ray, q, t.c, t.a), orientation) &&
        (rays_.state->has_mask(triangle) && keeps_masks_
             ? mask_before_light(rays_.filters, ray, q, rays_.state->masked(triangle)).sign >= 0
             : true);
    if (between) packet.crossed[l] += records_.copies(triangle);
}

Decision CountArbiter::behind(const EyeRay& ray, const RayPoint& q, const Corners& t) const {
    const Predicates& predicates = rays_.predicates;
    const bool at_eye =
        q.kind == RayPoint::Kind::eye || (q.kind == RayPoint::Kind::depth && q.depth == 0);
    return at_eye ? predicates.side_of_point_untied(ray, q, t)
                  : predicates.side_of_point(ray, q, t);
}

RayPoint CountArbiter::exact_point(const Prober::Point& point) const {
    if (point.kind != RayPoint::Kind::surface) return {.kind = point.kind, .depth = point.depth};
    return {.kind = point.kind, .surface = rays_.triangle(point.skip)};
}

} // namespace shadowproof
