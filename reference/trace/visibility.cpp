#include "reference/trace/visibility.h"

#include "reference/exact/norms.h"
#include "reference/trace/arbiters.h"
#include "reference/trace/plane_edges.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

constexpr double u = double_roundoff;

/// A ray from the light, and the limits of 1/s for being before the point that it leads to.
struct LightRay {
    ApproximateDirection w;
    HitLimits limits;
};

/// Up at the point q of a parallel view, off by `error` per component; hits that count are higher.
/// The errors are those of shear.h. Of a light that is far, but not so for q, nothing is known.
LightRay rising_to(const OriginView& view, const glm::dvec3& q, double error) {
    const Shear& shear = view.shear;
    const glm::dvec3 at = shear(q * view.scale);
    LightRay ray{{{at.x, at.y, 1}, (2 * error + 5 * u * largest(q)) * view.scale}, {}};
    double height_error = error * view.scale;
    if (shear.lean != 0) {
        const bool near_light = !(std::abs(1 - shear.divisor(q * view.scale)) < 0.25);
        ray.w.error = near_light ? std::numeric_limits<double>::infinity()
                                 : (4 * error + 22 * u * largest(q)) * view.scale;
        height_error = 2 * error * view.scale + 8 * u * largest(q) * view.scale;
        if (near_light) height_error = std::numeric_limits<double>::infinity();
    }
    ray.limits.lower_lo = -std::numeric_limits<float>::infinity();
    ray.limits.lower_hi = std::numeric_limits<float>::infinity();
    if (height_error < std::numeric_limits<double>::infinity()) {
        ray.limits.lower_lo = float_below(at.z - height_error);
        ray.limits.lower_hi = float_above(at.z + height_error);
    }
    return ray;
}

/// To the point at depth t of an eye ray, in the light view's scale: (E - O) + t D, each term
/// rounded, t itself off by t_error.
LightRay from_light_to(const Tracer::State& state, const glm::dvec3& direction, double t,
                       double t_error) {
    const OriginView& view = state.from_light;
    const glm::dvec3 base = state.eye - view.origin;
    const glm::dvec3 along = t * direction;
    // u for the difference, u for the product, u for the sum; 4 u for all with room.
    const double error = 4 * u * (largest(base) + largest(along)) + largest(direction) * t_error;
    if (view.parallel) return rising_to(view, base + along, error);
    // Between light and point: s < 1.
    return {{(base + along) * view.scale, error * view.scale}, {.lower_lo = 1, .lower_hi = 1}};
}

/// From a far light along D, to infinity: up at the place of which D is the vanishing point, at any
/// height; ((D_x - slope_u D_z), (D_y - slope_v D_z)) / -(lean D_z). The numerators are off by 6 u
/// of the largest |D|, the divisor by 5 u of itself.
LightRay from_far_light_to_infinity(const OriginView& view, const glm::dvec3& direction) {
    const Shear& shear = view.shear;
    const double z = direction[shear.axes[2]];
    const double down = -shear.lean * z; // positive where the ray comes down from the light
    const double size = largest(direction);
    // Away from the scene: beside all that is in it, though not beside what is outlying.
    LightRay ray{{{0x1p90, 0, 1}, 0}, {}};
    if (down > 0x1p-80 * size) {
        const glm::dvec3 place((direction[shear.axes[0]] - shear.slope_u * z) / down,
                               (direction[shear.axes[1]] - shear.slope_v * z) / down, 1);
        ray.w = {place, 7 * u * (size / down + largest(place))};
    }
    ray.limits.lower_lo = ray.limits.lower_hi = -std::numeric_limits<float>::infinity();
    return ray;
}

/// From the light along the eye ray's direction, to infinity; nothing where no triangle can be met.
/// Rays of a directional light leave the scene, except where D points straight away from the light:
/// there they meet everything above the eye's own place.
std::optional<LightRay> from_light_to_infinity(const Tracer::State& state,
                                               const glm::dvec3& direction) {
    if (!state.from_light.parallel) return LightRay{{direction, 0}, {}};
    if (state.from_light.shear.lean != 0)
        return from_far_light_to_infinity(state.from_light, direction);
    if (!state.predicates.runs_from_light({state.eye, direction, state.light})) return std::nullopt;
    LightRay ray = from_light_to(state, direction, 0, 0);
    ray.limits.lower_lo = ray.limits.lower_hi = -std::numeric_limits<float>::infinity();
    return ray;
}

template <class Work>
void for_lanes(std::uint32_t lanes, const Work& work) {
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) work(__builtin_ctz(left));
}

} // namespace

Prober::Prober(const Tracer::State& state, Filters filters)
    : state_(&state), filters_(filters), seen_(state.from_eye, Part::seen, state.double_sided),
      occluding_(state.from_light, Part::occluding, state.double_sided),
      light_facing_(state.from_light, Part::light_facing, state.double_sided) {}

/// t = numerator / denominator with running bounds; the bounds of both as in view.cpp.
void Prober::measure_depth(const glm::dvec3& direction, Seen& seen) {
    if (plane_.triangle != seen.triangle) {
        const PlaneEdges edges(corners(*state_->scene, seen.triangle));
        const glm::dvec3 to_plane = edges.a - state_->eye;
        plane_.triangle = seen.triangle;
        plane_.normal = glm::cross(edges.ab, edges.ac);
        plane_.normal_error = 8.1 * u * edges.product;
        plane_.numerator = glm::dot(to_plane, plane_.normal);
        plane_.numerator_error =
            50 * u * largest(to_plane) * edges.product / std::abs(plane_.numerator);
    }
    const double denominator = glm::dot(direction, plane_.normal);
    // The normal's error, and 3 roundings of 3 terms.
    const double size = largest(direction);
    const double denominator_error =
        size * (3.1 * plane_.normal_error + 9.1 * u * largest(plane_.normal));
    const double reciprocal = 1 / denominator;
    seen.depth = plane_.numerator * reciprocal;
    const double relative =
        plane_.numerator_error + denominator_error * std::abs(reciprocal) + 2 * u;
    // First order; doubled for the rest as long as it is small. Otherwise the error is unbounded.
    seen.depth_error = relative < 0.125 ? std::abs(seen.depth) * 2 * relative
                                        : std::numeric_limits<double>::infinity();
}

void Prober::see(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, Lanes<Seen>& seen) {
    see_triangle(directions, lanes, range_of(state_->scene->camera), seen);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        if (seen[l].triangle == no_triangle) {
            seen[l].depth = std::numeric_limits<double>::infinity();
            return;
        }
        if (seen_.copies(seen[l].triangle) > 1) seen[l].exactness = Exactness::degenerate;
        measure_depth(directions[l], seen[l]);
    });
}

void Prober::see_triangle(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                          const SeenRange& range, Lanes<Seen>& seen) {
    const double scale = state_->from_eye.scale;
    HitLimits limits;
    limits.lower_lo = std::isinf(range.far) ? 0 : float_below(1 / (range.far * scale));
    limits.lower_hi = std::isinf(range.far) ? 0 : float_above(1 / (range.far * scale));
    limits.upper_lo = float_below(1 / (range.near * scale));
    limits.upper_hi = float_above(1 / (range.near * scale));
    RayPacket packet = empty_packet(filters_);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        seen[l] = {};
        set_lane(packet, lane, {directions[l], 0}, limits, no_plane);
        ++rays_;
    });
    PacketRays rays{state_, &directions, Predicates(filters_)};
    NearestArbiter arbiter(rays, range, seen);
    find_nearest(packet, seen_, arbiter);
    exact_decisions_ += rays.exact_decisions;
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        seen[l].triangle = packet.hit[l];
    });
}

void Prober::ask_cone(const glm::dvec3& direction, const Seen& seen, Lighting& lighting) {
    const RayPoint point{.kind = RayPoint::Kind::surface,
                         .surface = corners(*state_->scene, seen.triangle)};
    const Decision decision = Predicates(filters_).within_cone(
        {state_->eye, direction, state_->light}, point, *state_->cone);
    exact_decisions_ += decision.exactness != Exactness::filtered ? 1 : 0;
    lighting.exactness = std::max(lighting.exactness, decision.exactness);
    lighting.in_cone = decision.sign >= 0;
}

/// The segment begins in the plane of what is seen, and only there could a triangle of it be met.
void Prober::set_shadow_ray(RayPacket& packet, int lane, const glm::dvec3& direction,
                            const Seen& seen) const {
    const LightRay ray = from_light_to(*state_, direction, seen.depth, seen.depth_error);
    set_lane(packet, lane, ray.w, ray.limits, state_->places.plane[seen.triangle]);
}

void Prober::light(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                   const Lanes<Seen>& seen, Lanes<Lighting>& lighting) {
    RayPacket packet = empty_packet(filters_);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        const std::uint32_t triangle = seen[l].triangle;
        lighting[l] = {};
        if (triangle == no_triangle) return;
        if (state_->side_of_light[triangle] == 0) lighting[l].exactness = Exactness::degenerate;
        if (state_->cone) ask_cone(directions[l], seen[l], lighting[l]);
        if (!state_->faces_light(triangle) || !lighting[l].in_cone) return;
        lighting[l].lit = state_->receives[triangle] == 0;
        if (lighting[l].lit) return;
        set_shadow_ray(packet, lane, directions[l], seen[l]);
        ++rays_;
    });
    const std::uint32_t asked = packet.active;
    PacketRays rays{state_, &directions, Predicates(filters_)};
    AnyArbiter arbiter(rays, seen, lighting);
    find_any(packet, occluding_, arbiter);
    exact_decisions_ += rays.exact_decisions;
    for_lanes(asked, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        lighting[l].lit = packet.hit[l] == no_triangle;
    });
}

void Prober::occluders(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                       const Lanes<Seen>& seen, Lanes<std::uint32_t>& triangles) {
    RayPacket packet = empty_packet(filters_);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        Lighting lighting;
        if (seen[l].triangle == no_triangle || !state_->faces_light(seen[l].triangle) ||
            state_->receives[seen[l].triangle] == 0)
            return;
        if (state_->cone) ask_cone(directions[l], seen[l], lighting);
        if (lighting.in_cone) set_shadow_ray(packet, lane, directions[l], seen[l]);
    });
    PacketRays rays{state_, &directions, Predicates(filters_)};
    LowestArbiter arbiter(rays, seen);
    find_lowest(packet, occluding_, arbiter);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        triangles[l] = packet.hit[l];
    });
}

void Prober::count(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                   const Lanes<Point>& points, Lanes<std::int32_t>& counts) {
    RayPacket packet = empty_packet(filters_);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        const Point& point = points[l];
        Seen at{.triangle = point.skip, .depth = point.depth};
        if (point.kind == RayPoint::Kind::surface) measure_depth(directions[l], at);
        const std::optional<LightRay> ray =
            point.kind == RayPoint::Kind::infinity
                ? from_light_to_infinity(*state_, directions[l])
                : from_light_to(*state_, directions[l], at.depth, at.depth_error);
        const std::uint32_t plane =
            point.skip == no_triangle ? no_plane : state_->places.plane[point.skip];
        if (ray) set_lane(packet, lane, ray->w, ray->limits, plane);
    });
    PacketRays rays{state_, &directions, Predicates(filters_)};
    CountArbiter arbiter(rays, points, light_facing_);
    count_all(packet, light_facing_, arbiter);
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        counts[l] = static_cast<std::int32_t>(packet.crossed[l]);
        // A light-facing triangle seen from behind lies between its own surface and the light.
        const std::uint32_t own = points[l].skip;
        if (own != no_triangle && state_->from_light.side[own] < 0 &&
            state_->from_eye.side[own] > 0)
            ++counts[l];
    });
}

} // namespace shadowproof
