#include "reference/trace/parallel_sight.h"

#include "reference/exact/norms.h"
#include "scenes/roundoff.h"

#include <cmath>
#include <limits>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/parallel_sight.cpp"
// The order matters.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "reference/walk/double_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

/// Of the line's start above the view's origin, and how far below it a depth lies: the height is
/// off by a rounding of either, and their difference by one of both. `low`, `high`: floats on
/// either side of it, further out by 2^-23 of itself or of the smallest normal float.
void store_height(Number start, double down, double scale, Lanes<float>& low, Lanes<float>& high,
                  std::size_t i) {
    const Number height = hn::Mul(hn::Sub(start, number(down)), number(scale));
    const Number size = hn::Add(hn::Abs(start), number(down));
    const Number error = hn::Mul(size, number(3 * double_roundoff * scale));
    const Number room =
        hn::Add(error, hn::Add(hn::Mul(hn::Abs(height), number(0x1p-23)), number(0x1p-149)));
    store(hn::Sub(height, room), low, i);
    store(hn::Add(height, room), high, i);
}

/// A line of sight in the view's sheared coordinates is the same all along, but for the height,
/// which falls with the depth. Its direction is the one that the shear follows, but slopes are
/// rounded: the errors of shear.h, 2 e + 4.1 u m with e = u m, hold at its start, and those of a
/// triangle's corners cover the way to them.
void set_lines(const Tracer::State& state, const Vectors& lines, const SeenRange& range,
               RayPacket& packet) {
    const OriginView& view = state.from_eye;
    const Shear& shear = view.shear;
    const double fall = std::abs(state.scene->camera.forward[shear.axes[2]]);
    const Number scale = number(view.scale);
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        const auto from_origin = [&](std::size_t k) {
            const int axis = shear.axes[k];
            return hn::Sub(load(lines.axis[static_cast<std::size_t>(axis)], i),
                           number(view.origin[axis]));
        };
        const Number u = from_origin(0);
        const Number v = from_origin(1);
        const Number z = from_origin(2);
        const auto sheared = [&](Number of, double slope) {
            return hn::Mul(hn::Sub(of, hn::Mul(number(slope), z)), scale);
        };
        store(sheared(u, shear.slope_u), packet.direction.axis[0], i);
        store(sheared(v, shear.slope_v), packet.direction.axis[1], i);
        store(number(1), packet.direction.axis[2], i);
        const Number size = hn::Max(hn::Max(hn::Abs(u), hn::Abs(v)), hn::Abs(z));
        store(hn::Mul(size, number(7 * double_roundoff * view.scale)), packet.direction_error, i);
        const Number start = hn::Mul(number(shear.up), z);
        store_height(start, range.near * fall, view.scale, packet.upper_lo, packet.upper_hi, i);
        if (std::isfinite(range.far)) {
            store_height(start, range.far * fall, view.scale, packet.lower_lo, packet.lower_hi, i);
        } else {
            store(number(-std::numeric_limits<double>::infinity()), packet.lower_lo, i);
            store(number(-std::numeric_limits<double>::infinity()), packet.lower_hi, i);
        }
    }
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(set_lines);
} // namespace

void look_along(const Tracer::State& state, const Vectors& lines, std::uint32_t lanes,
                const SeenRange& range, RayPacket& packet) {
    HWY_DYNAMIC_DISPATCH(set_lines)(state, lines, range, packet);
    packet.active |= lanes;
}

// As store_height.
std::pair<double, double> heights_at(const Tracer::State& state, const glm::dvec3& line, double t,
                                     double t_error) {
    const OriginView& view = state.from_eye;
    const int axis = view.shear.axes[2];
    const double start = view.shear.up * (line[axis] - view.origin[axis]);
    const double fall = std::abs(state.scene->camera.forward[axis]);
    const double down = t * fall;
    const double error =
        3 * double_roundoff * (std::abs(start) + std::abs(down)) + 2 * fall * t_error;
    return {(start - down - error) * view.scale, (start - down + error) * view.scale};
}

} // namespace shadowproof
#endif
