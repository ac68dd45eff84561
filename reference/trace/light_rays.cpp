#include "reference/trace/light_rays.h"

#include "reference/exact/norms.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/light_rays.cpp"
// The order matters.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "reference/walk/double_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

constexpr double u = double_roundoff;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Vector {
    std::array<Number, 3> axis;
};
Number largest(const Vector& p) {
    return hn::Max(hn::Max(hn::Abs(p.axis[0]), hn::Abs(p.axis[1])), hn::Abs(p.axis[2]));
}

/// Sets a ray up at the point q of a parallel view, off by `error` per component; hits that count
/// are higher. The errors are those of shear.h. Of a light that is far, but not so for q, nothing
/// is known.
void rise_to(const OriginView& view, const Vector& q, Number error, RayPacket& packet,
             std::size_t i) {
    const Shear& shear = view.shear;
    const auto scaled = [&](std::size_t k) {
        return hn::Mul(q.axis[static_cast<std::size_t>(shear.axes[k])], number(view.scale));
    };
    const Number z = scaled(2);
    const Number divisor = hn::Sub(number(1), hn::Mul(number(shear.lean), z));
    const auto sheared = [&](std::size_t k, double slope) {
        return hn::Div(hn::Sub(scaled(k), hn::Mul(number(slope), z)), divisor);
    };
    const Number height = hn::Div(hn::Mul(number(shear.up), z), divisor);
    const bool leans = shear.lean != 0;
    const Number scale = number(view.scale);
    const Number size = hn::Mul(number(u), largest(q));
    Number place_error = hn::Mul(
        hn::Add(hn::Mul(number(leans ? 4 : 2), error), hn::Mul(number(leans ? 22 : 5), size)),
        scale);
    Number height_error = hn::Mul(
        leans ? hn::Add(hn::Mul(number(2), error), hn::Mul(number(8), size)) : error, scale);
    if (leans) {
        const auto far = hn::Lt(hn::Abs(hn::Sub(number(1), divisor)), number(0.25));
        place_error = hn::IfThenElse(far, place_error, number(infinity));
        height_error = hn::IfThenElse(far, height_error, number(infinity));
    }
    store(sheared(0, shear.slope_u), packet.direction.axis[0], i);
    store(sheared(1, shear.slope_v), packet.direction.axis[1], i);
    store(number(1), packet.direction.axis[2], i);
    store(place_error, packet.direction_error, i);
    // Rounded to float and further by more: by 2^-23 of itself, or of the smallest normal float.
    const Number rounding = hn::Add(hn::Mul(hn::Abs(height), number(0x1p-23)), number(0x1p-149));
    const auto known = hn::Lt(height_error, number(infinity));
    const auto limit = [&](Number value, double otherwise) {
        return hn::IfThenElse(known, value, number(otherwise));
    };
    const Number room =
        hn::Add(height_error, hn::Add(rounding, hn::Mul(height_error, number(0x1p-23))));
    store(limit(hn::Sub(height, room), -infinity), packet.lower_lo, i);
    store(limit(hn::Add(height, room), infinity), packet.lower_hi, i);
    store(number(infinity), packet.upper_lo, i);
    store(number(infinity), packet.upper_hi, i);
}

void lead_to_points(const Tracer::State& state, const Vectors& lines, const Lanes<double>& t,
                    const Lanes<double>& t_error, RayPacket& packet) {
    const OriginView& view = state.from_light;
    const Camera& camera = state.scene->camera;
    const bool is_parallel = camera.is_orthographic();
    const glm::dvec3 one_base = camera.eye - view.origin;
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        // (E - O) + t D, E where the line starts: u for the difference, u for the product, u for
        // the sum; 4 u for all with room.
        Vector base;
        Vector direction;
        Vector along;
        Vector q;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int k = static_cast<int>(axis);
            const Number line = load(lines.axis[axis], i);
            base.axis[axis] =
                is_parallel ? hn::Sub(line, number(view.origin[k])) : number(one_base[k]);
            direction.axis[axis] = is_parallel ? number(camera.forward[k]) : line;
            along.axis[axis] = hn::Mul(load(t, i), direction.axis[axis]);
            q.axis[axis] = hn::Add(base.axis[axis], along.axis[axis]);
        }
        const Number error = hn::Add(hn::Mul(number(4 * u), hn::Add(largest(base), largest(along))),
                                     hn::Mul(largest(direction), load(t_error, i)));
        if (view.parallel) {
            rise_to(view, q, error, packet, i);
            continue;
        }
        const Number scale = number(view.scale);
        for (std::size_t axis = 0; axis < 3; ++axis)
            store(hn::Mul(q.axis[axis], scale), packet.direction.axis[axis], i);
        store(hn::Mul(error, scale), packet.direction_error, i);
        // Between light and point: s < 1.
        store(number(1), packet.lower_lo, i);
        store(number(1), packet.lower_hi, i);
        store(number(infinity), packet.upper_lo, i);
        store(number(infinity), packet.upper_hi, i);
    }
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {

HWY_EXPORT(lead_to_points);

constexpr double u = double_roundoff;
constexpr float no_limit = std::numeric_limits<float>::infinity();

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
    ray.limits.lower_lo = ray.limits.lower_hi = -no_limit;
    return ray;
}

} // namespace

void lead_to_points(const Tracer::State& state, const Vectors& lines, const Lanes<double>& t,
                    const Lanes<double>& t_error, RayPacket& packet) {
    HWY_DYNAMIC_DISPATCH(lead_to_points)(state, lines, t, t_error, packet);
}

// Rays of a directional light leave the scene, except where D points straight away from the light:
// there they meet everything above the place where the line of sight starts. That is a tie: where
// lines of sight are parallel, all would be tied, and D is moved as the predicates move it.
std::optional<LightRay> lead_to_infinity(const Tracer::State& state, const glm::dvec3& line,
                                         RayPoint::Kind kind) {
    const Camera& camera = state.scene->camera;
    const glm::dvec3 forward = direction_of(camera, line);
    const glm::dvec3 direction = kind == RayPoint::Kind::eye ? -forward : forward;
    if (!state.from_light.parallel) return LightRay{{direction, 0}, {}};
    if (state.from_light.shear.lean != 0)
        return from_far_light_to_infinity(state.from_light, direction);
    if (camera.is_orthographic() || !state.predicates.runs_from_light(state.ray(line)))
        return std::nullopt;
    RayPacket packet;
    Vectors lines;
    lines.set(0, line);
    lead_to_points(state, lines, {}, {}, packet);
    LightRay ray{{packet.direction[0], packet.direction_error[0]}, {}};
    ray.limits.lower_lo = ray.limits.lower_hi = -no_limit;
    return ray;
}

} // namespace shadowproof
#endif
