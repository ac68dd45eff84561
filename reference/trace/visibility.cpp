#include "reference/trace/visibility.h"

#include "reference/trace/arbiters.h"
#include "reference/trace/light_rays.h"
#include "reference/trace/parallel_sight.h"
#include "reference/trace/plane_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

template <class Work>
void for_lanes(std::uint32_t lanes, const Work& work) {
    for (std::uint32_t left = lanes; left != 0; left &= left - 1)
        work(static_cast<std::size_t>(__builtin_ctz(left)));
}

/// One bit per lane of `lanes` for which `holds` is true.
template <class Holds>
std::uint32_t lanes_where(std::uint32_t lanes, const Holds& holds) {
    std::uint32_t found = 0;
    for_lanes(lanes, [&](std::size_t l) { found |= holds(l) ? 1U << l : 0U; });
    return found;
}

} // namespace

Prober::Prober(const Tracer::State& state, Filters filters)
    : state_(&state), filters_(filters),
      seen_(state.from_eye, Part::seen, state.double_sided, &state.masks),
      occluding_(state.from_light, Part::occluding, state.double_sided, &state.masks),
      light_facing_(state.from_light, Part::light_facing, state.double_sided, nullptr),
      light_facing_masked_(state.from_light, Part::light_facing, state.double_sided, &state.masks),
      planes_(*state.scene), own_range_(range_of(state.scene->camera)) {}

PacketRays Prober::packet_rays(const Vectors& lines) const {
    return {.state = state_,
            .lines = &lines,
            .predicates = Predicates(filters_),
            .filters = filters_,
            .leeway = leeway_};
}

void Prober::see(const Vectors& lines, std::uint32_t lanes, SeenLanes& seen) {
    see(lines, lanes, own_range_, nullptr, seen);
}

void Prober::see(const Vectors& lines, std::uint32_t lanes, const SeenRange& range,
                 const PacketMasks* masks, SeenLanes& seen) {
    leeway_ = masks;
    see_triangle(lines, lanes, range, seen);
    leeway_ = nullptr;
    const std::uint32_t met =
        lanes_where(lanes, [&](std::size_t l) { return seen.triangle[l] != no_triangle; });
    for_lanes(lanes & ~met, [&](std::size_t l) {
        seen.depth[l] = std::numeric_limits<double>::infinity();
        seen.depth_error[l] = 0;
    });
    for_lanes(met, [&](std::size_t l) {
        if ((state_->facing[seen.triangle[l]] & copied_bit) != 0 &&
            seen_.copies(seen.triangle[l]) > 1)
            seen.exactness[l] = Exactness::degenerate;
    });
    planes_.measure(lines, met, seen.triangle, seen.depth, seen.depth_error);
}

void Prober::see_triangle(const Vectors& lines, std::uint32_t lanes, const SeenRange& range,
                          SeenLanes& seen) {
    const bool is_parallel = state_->from_eye.parallel;
    if (range != range_ && !is_parallel) {
        range_ = range;
        const double scale = state_->from_eye.scale;
        limits_.lower_lo =
            std::isinf(range.far) ? 0 : std::max(0.0F, float_below(1 / (range.far * scale)));
        limits_.lower_hi = std::isinf(range.far) ? 0 : float_above(1 / (range.far * scale));
        limits_.upper_lo = float_below(1 / (range.near * scale));
        limits_.upper_hi = float_above(1 / (range.near * scale));
    }
    clear(packet_, filters_);
    if (is_parallel)
        look_along(*state_, lines, lanes, range, packet_);
    else
        set_lanes(packet_, lanes, lines, limits_);
    rays_ += static_cast<std::uint64_t>(std::popcount(lanes));
    seen.exactness.fill(Exactness::filtered);
    PacketRays rays = packet_rays(lines);
    NearestArbiter arbiter(rays, range, seen);
    find_nearest(packet_, seen_, arbiter);
    exact_decisions_ += rays.exact_decisions;
    undecided_ += rays.undecided;
    seen.triangle = packet_.hit;
}

/// A sign of at least zero is in the cone.
Decision Prober::ask_cone(const glm::dvec3& line, std::uint32_t seen) {
    const RayPoint point{.kind = RayPoint::Kind::surface, .surface = corners(*state_->scene, seen)};
    const Decision decision =
        Predicates(filters_).within_cone(state_->ray(line), point, *state_->cone);
    exact_decisions_ += decision.exactness != Exactness::filtered ? 1 : 0;
    return decision;
}

/// The segments begin in the planes of what is seen, and only there could triangles in them be met.
void Prober::set_shadow_rays(const Vectors& lines, std::uint32_t lanes, const SeenLanes& seen) {
    clear(packet_, filters_);
    lead_to_points(*state_, lines, seen.depth, seen.depth_error, packet_);
    packet_.active = lanes;
    for_lanes(lanes,
              [&](std::size_t l) { packet_.skip[l] = state_->places.plane[seen.triangle[l]]; });
}

void Prober::light(const Vectors& lines, std::uint32_t lanes, const SeenLanes& seen,
                   LitLanes& lighting) {
    lighting.exactness.fill(Exactness::filtered);
    lighting.in_cone.fill(1);
    std::uint32_t asked = 0;
    for_lanes(lanes, [&](std::size_t l) {
        const std::uint32_t triangle = seen.triangle[l];
        lighting.visibility[l] = Visibility::background;
        if (triangle == no_triangle) return;
        const std::uint8_t facing = state_->facing[triangle];
        if (state_->cone) {
            const Decision decision = ask_cone(lines[l], triangle);
            lighting.in_cone[l] = decision.sign >= 0 ? 1 : 0;
            lighting.exactness[l] = decision.exactness;
        }
        if ((facing & edge_on_bit) != 0) lighting.exactness[l] = Exactness::degenerate;
        const bool may_be_lit = (facing & faces_light_bit) != 0 && lighting.in_cone[l] != 0;
        const bool receives = (facing & receives_bit) != 0;
        lighting.visibility[l] = may_be_lit && !receives ? Visibility::lit : Visibility::shadowed;
        asked |= may_be_lit && receives ? 1U << l : 0U;
    });
    if (asked == 0) return;
    rays_ += static_cast<std::uint64_t>(std::popcount(asked));
    set_shadow_rays(lines, asked, seen);
    PacketRays rays = packet_rays(lines);
    AnyArbiter arbiter(rays, seen, lighting);
    find_any(packet_, occluding_, arbiter);
    exact_decisions_ += rays.exact_decisions;
    undecided_ += rays.undecided;
    for_lanes(asked, [&](std::size_t l) {
        if (packet_.hit[l] == no_triangle) lighting.visibility[l] = Visibility::lit;
    });
}

void Prober::occluders(const Vectors& lines, std::uint32_t lanes, const SeenLanes& seen,
                       Lanes<std::uint32_t>& triangles) {
    const std::uint32_t asked = lanes_where(lanes, [&](std::size_t l) {
        const std::uint32_t triangle = seen.triangle[l];
        return triangle != no_triangle && state_->faces_light(triangle) &&
               state_->receives[triangle] != 0 &&
               (!state_->cone || ask_cone(lines[l], triangle).sign >= 0);
    });
    set_shadow_rays(lines, asked, seen);
    PacketRays rays = packet_rays(lines);
    LowestArbiter arbiter(rays, seen);
    find_lowest(packet_, occluding_, arbiter);
    for_lanes(lanes, [&](std::size_t l) { triangles[l] = packet_.hit[l]; });
}

void Prober::count(const Vectors& lines, std::uint32_t lanes, const Lanes<Point>& points,
                   Lanes<std::int32_t>& counts, Masks masks) {
    Lanes<double> depth{};
    Lanes<double> depth_error{};
    Lanes<std::uint32_t> own{};
    const std::uint32_t at_surface = lanes_where(lanes, [&](std::size_t l) {
        depth[l] = points[l].depth;
        own[l] = points[l].skip;
        return points[l].kind == RayPoint::Kind::surface;
    });
    planes_.measure(lines, at_surface, own, depth, depth_error);
    clear(packet_, filters_);
    lead_to_points(*state_, lines, depth, depth_error, packet_);
    packet_.active = lanes;
    for_lanes(lanes, [&](std::size_t l) {
        if (own[l] != no_triangle) packet_.skip[l] = state_->places.plane[own[l]];
        const RayPoint::Kind kind = points[l].kind;
        if (kind != RayPoint::Kind::infinity && kind != RayPoint::Kind::eye) return;
        if (const std::optional<LightRay> ray = lead_to_infinity(*state_, lines[l], kind))
            set_lane(packet_, static_cast<int>(l), ray->w, ray->limits, packet_.skip[l]);
        else
            packet_.active &= ~(1U << l);
    });
    PacketRays rays = packet_rays(lines);
    RecordCache& records = masks == Masks::kept ? light_facing_masked_ : light_facing_;
    CountArbiter arbiter(rays, points, records, masks);
    count_all(packet_, records, arbiter);
    for_lanes(lanes, [&](std::size_t l) {
        counts[l] = static_cast<std::int32_t>(packet_.crossed[l]);
        // A light-facing triangle seen from behind lies between its own surface and the light.
        if (own[l] != no_triangle && state_->from_light.side[own[l]] < 0 &&
            state_->from_eye.side[own[l]] > 0)
            ++counts[l];
    });
}

} // namespace shadowproof
