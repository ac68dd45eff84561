#include "reference/trace/visibility.h"

#include "reference/exact/norms.h"
#include "reference/trace/faces.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

constexpr double u = double_roundoff;

float below(double x) {
    return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float above(double x) {
    return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

/// Two edges of a triangle, from which its plane is computed in double.
struct PlaneEdges {
    glm::dvec3 a, ab, ac;
    double product; ///< of their lengths, or more; bounds the normal's errors

    explicit PlaneEdges(const Corners& given) {
        const Corners t = from_short_edge(given);
        a = t.a;
        ab = t.b - t.a;
        ac = t.c - t.a;
        const double longer = std::max(largest(ab), largest(ac));
        const double shorter = std::min(largest(ab), largest(ac));
        product = (shorter < 0x1p-20 * longer ? shorter : longer) * longer;
    }
};

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

/// What all arbiters need of their rays.
struct Question {
    const Tracer::State* state = nullptr;
    const Lanes<glm::dvec3>* directions = nullptr;
    std::uint64_t exact_decisions = 0;

    EyeRay ray(int lane) const {
        return {state->eye, (*directions)[static_cast<std::size_t>(lane)], state->light};
    }
    Corners triangle(std::uint32_t index) const { return corners(*state->scene, index); }
};

class NearestArbiter final : public Arbiter {
public:
    NearestArbiter(Question& question, Lanes<Seen>& seen) : question_(question), seen_(seen) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle) override {
        Signs signs;
        const bool nearer = is_nearer(packet, lane, triangle, signs);
        question_.exact_decisions += signs.exact_decisions();
        Seen& seen = seen_[static_cast<std::size_t>(lane)];
        // A miss that was decided exactly is recorded too; but a tie counts only where the triangle
        // is met.
        seen.exactness =
            std::max(seen.exactness,
                     met_ ? signs.exactness() : std::min(signs.exactness(), Exactness::exact));
        if (!nearer) return;
        packet.hit[static_cast<std::size_t>(lane)] = triangle;
        // Depth in double, widened to certain floats.
        const EyeRay ray = question_.ray(lane);
        const Corners t = question_.triangle(triangle);
        raise_to_depth(packet, lane, ray, t);
    }

private:
    Question& question_;
    Lanes<Seen>& seen_;
    Lanes<std::optional<glm::dvec3>> vertex_{}; ///< through which the lane's ray runs exactly
    bool met_ = false; ///< the last tested triangle is met within [near, far]

    bool is_nearer(const RayPacket& packet, int lane, std::uint32_t triangle, Signs& signs) {
        const EyeRay ray = question_.ray(lane);
        const Corners t = question_.triangle(triangle);
        const int orientation = question_.state->from_eye.side[triangle];
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
        const Decision order =
            question_.state->predicates.depth_order(ray, t, question_.triangle(best));
        signs.at_least_zero(order, 1);
        return order.sign < 0 || (order.sign == 0 && triangle < best);
    }

    /// Predicates::edge; edges at a vertex that the ray runs through are all met.
    Decision edge(const EyeRay& ray, int lane, const glm::dvec3& a, const glm::dvec3& b) const {
        const std::optional<glm::dvec3>& vertex = vertex_[static_cast<std::size_t>(lane)];
        if (vertex && (*vertex == a || *vertex == b)) return {0, Exactness::degenerate};
        return question_.state->predicates.edge(ray, a, b);
    }

    /// Whether the ray meets both triangles in one point because they share it: the vertex that it
    /// runs through, or an edge.
    bool meet_there(int lane, const std::array<glm::dvec3, 3>& corners,
                    const std::array<bool, 3>& through, std::uint32_t best) const {
        const Corners other = question_.triangle(best);
        const auto shares = [&](const glm::dvec3& p) {
            return p == other.a || p == other.b || p == other.c;
        };
        const std::optional<glm::dvec3>& vertex = vertex_[static_cast<std::size_t>(lane)];
        if (vertex && shares(*vertex) && std::ranges::count(corners, *vertex) > 0) return true;
        for (std::size_t k = 0; k < 3; ++k)
            if (through[k] && shares(corners[k]) && shares(corners[(k + 1) % 3])) return true;
        return false;
    }

    bool within_planes(const EyeRay& ray, const Corners& t, Signs& signs) const {
        const Camera& camera = question_.state->scene->camera;
        const Predicates& predicates = question_.state->predicates;
        return signs.at_least_zero(predicates.depth_against(ray, t, camera.near), 1) &&
               (std::isinf(camera.far) ||
                signs.at_least_zero(predicates.depth_against(ray, t, camera.far), -1));
    }

    void raise_to_depth(RayPacket& packet, int lane, const EyeRay& ray, const Corners& t) const {
        const PlaneEdges edges(t);
        const glm::dvec3 normal = glm::cross(edges.ab, edges.ac);
        const glm::dvec3 to_plane = edges.a - ray.eye;
        // As in view.cpp: 8 u l^2 per component, 50 u m l^2 for the dot product.
        const double numerator = glm::dot(to_plane, normal);
        const double numerator_error = 50 * u * largest(to_plane) * edges.product;
        const double denominator = glm::dot(ray.direction, normal);
        const double denominator_error = 50 * u * largest(ray.direction) * edges.product;
        const double scale = question_.state->from_eye.scale;
        // The plane is too near the eye to tell: all further candidates must be compared exactly.
        if (!(std::abs(numerator) > 4 * numerator_error)) {
            packet.lower_hi[static_cast<std::size_t>(lane)] =
                std::numeric_limits<float>::infinity();
            return;
        }
        // 1/s = denominator / (numerator scale). The numerator may be smaller by a quarter, which
        // makes its relative error and the denominator's share up to 4/3 as large: 1.5 covers that
        // and second order, 4 u the roundings.
        const double inverse = denominator / (numerator * scale);
        const double error =
            std::abs(inverse) * (1.5 * numerator_error / std::abs(numerator) + 4 * u) +
            1.5 * denominator_error / std::abs(numerator * scale);
        raise_lower_limit(packet, lane, std::max(below(inverse - error), 0.0F),
                          above(inverse + error));
    }
};

class AnyArbiter final : public Arbiter {
public:
    AnyArbiter(Question& question, const Lanes<Seen>& seen, Lanes<Lighting>& lighting)
        : question_(question), seen_(seen), lighting_(lighting) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle) override {
        const auto l = static_cast<std::size_t>(lane);
        Signs signs;
        const RayPoint point{.kind = RayPoint::Kind::surface,
                             .surface = question_.triangle(seen_[l].triangle)};
        const bool blocked = is_between(question_.ray(lane), point, triangle, signs);
        question_.exact_decisions += signs.exact_decisions();
        lighting_[l].exactness =
            std::max(lighting_[l].exactness,
                     touched_ ? signs.exactness() : std::min(signs.exactness(), Exactness::exact));
        if (!blocked) return;
        packet.hit[l] = triangle;
        finish_lane(packet, lane);
    }

private:
    Question& question_;
    const Lanes<Seen>& seen_;
    Lanes<Lighting>& lighting_;
    bool touched_ = false; ///< no sign was strictly against it

    bool is_between(const EyeRay& ray, const RayPoint& q, std::uint32_t triangle, Signs& signs) {
        const Predicates& predicates = question_.state->predicates;
        const Corners t = question_.triangle(triangle);
        const int orientation = question_.state->from_light.side[triangle];
        const Decision beyond = predicates.side_of_point(ray, q, t);
        touched_ = signs.at_least_zero(beyond, orientation) &&
                   signs.at_least_zero(predicates.shadow_edge(ray, q, t.a, t.b), orientation) &&
                   signs.at_least_zero(predicates.shadow_edge(ray, q, t.b, t.c), orientation) &&
                   signs.at_least_zero(predicates.shadow_edge(ray, q, t.c, t.a), orientation);
        return touched_ && beyond.sign != 0;
    }
};

class CountArbiter final : public Arbiter {
public:
    CountArbiter(Question& question, const Lanes<Prober::Point>& points, const RecordCache& records)
        : question_(question), points_(points), records_(records) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle) override {
        const auto l = static_cast<std::size_t>(lane);
        const EyeRay ray = question_.ray(lane);
        const RayPoint q = exact_point(points_[l]);
        const Predicates& predicates = question_.state->predicates;
        const Corners t = question_.triangle(triangle);
        const int orientation = question_.state->from_light.side[triangle];
        Signs signs;
        const bool between =
            signs.above_zero(behind(ray, q, t), orientation) &&
            signs.above_zero(predicates.shadow_edge_untied(ray, q, t.a, t.b), orientation) &&
            signs.above_zero(predicates.shadow_edge_untied(ray, q, t.b, t.c), orientation) &&
            signs.above_zero(predicates.shadow_edge_untied(ray, q, t.c, t.a), orientation);
        question_.exact_decisions += signs.exact_decisions();
        if (between) packet.crossed[l] += records_.copies(triangle);
    }

private:
    Question& question_;
    const Lanes<Prober::Point>& points_;
    const RecordCache& records_;

    /// Whether a point is behind a cap. A surface in the cap's plane is not. The eye is always on
    /// one side or the other: a ray from there has left the volume it began in, or has not.
    Decision behind(const EyeRay& ray, const RayPoint& q, const Corners& t) const {
        const Predicates& predicates = question_.state->predicates;
        const bool at_eye = q.kind == RayPoint::Kind::depth && q.depth == 0;
        return at_eye ? predicates.side_of_point_untied(ray, q, t)
                      : predicates.side_of_point(ray, q, t);
    }

    RayPoint exact_point(const Prober::Point& point) const {
        if (point.kind != RayPoint::Kind::surface)
            return {.kind = point.kind, .depth = point.depth};
        return {.kind = point.kind, .surface = question_.triangle(point.skip)};
    }
};

/// A ray from the light, and the limits of 1/s for being before the point that it leads to.
struct LightRay {
    ApproximateDirection w;
    Limits limits;
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
        ray.limits.lower_lo = below(at.z - height_error);
        ray.limits.lower_hi = above(at.z + height_error);
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

Prober::Prober(const Tracer::State& state)
    : state_(&state), seen_(state.from_eye, Part::seen, state.double_sided),
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
    const Camera& camera = state_->scene->camera;
    const double scale = state_->from_eye.scale;
    Limits limits;
    limits.lower_lo = std::isinf(camera.far) ? 0 : below(1 / (camera.far * scale));
    limits.lower_hi = std::isinf(camera.far) ? 0 : above(1 / (camera.far * scale));
    limits.upper_lo = below(1 / (camera.near * scale));
    limits.upper_hi = above(1 / (camera.near * scale));
    RayPacket packet = empty_packet();
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        seen[l] = {};
        set_lane(packet, lane, {directions[l], 0}, limits, no_plane);
        ++rays_;
    });
    Question question{state_, &directions, 0};
    NearestArbiter arbiter(question, seen);
    find_nearest(packet, seen_, arbiter);
    exact_decisions_ += question.exact_decisions;
    for_lanes(lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        seen[l].triangle = packet.hit[l];
        if (seen[l].triangle == no_triangle) {
            seen[l].depth = std::numeric_limits<double>::infinity();
            return;
        }
        if (seen_.copies(seen[l].triangle) > 1) seen[l].exactness = Exactness::degenerate;
        measure_depth(directions[l], seen[l]);
    });
}

void Prober::ask_cone(const glm::dvec3& direction, const Seen& seen, Lighting& lighting) {
    const RayPoint point{.kind = RayPoint::Kind::surface,
                         .surface = corners(*state_->scene, seen.triangle)};
    const Decision decision = state_->predicates.within_cone(
        {state_->eye, direction, state_->light}, point, *state_->cone);
    exact_decisions_ += decision.exactness != Exactness::filtered ? 1 : 0;
    lighting.exactness = std::max(lighting.exactness, decision.exactness);
    lighting.in_cone = decision.sign >= 0;
}

void Prober::light(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                   const Lanes<Seen>& seen, Lanes<Lighting>& lighting) {
    RayPacket packet = empty_packet();
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
        const LightRay ray =
            from_light_to(*state_, directions[l], seen[l].depth, seen[l].depth_error);
        // The segment begins in that plane, and only there could a triangle of it be met.
        set_lane(packet, lane, ray.w, ray.limits, state_->places.plane[triangle]);
        ++rays_;
    });
    const std::uint32_t asked = packet.active;
    Question question{state_, &directions, 0};
    AnyArbiter arbiter(question, seen, lighting);
    find_any(packet, occluding_, arbiter);
    exact_decisions_ += question.exact_decisions;
    for_lanes(asked, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        lighting[l].occluder = packet.hit[l];
        lighting[l].lit = packet.hit[l] == no_triangle;
    });
}

void Prober::count(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                   const Lanes<Point>& points, Lanes<std::int32_t>& counts) {
    RayPacket packet = empty_packet();
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
    Question question{state_, &directions, 0};
    CountArbiter arbiter(question, points, light_facing_);
    count_all(packet, light_facing_, arbiter);
    exact_decisions_ += question.exact_decisions;
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
