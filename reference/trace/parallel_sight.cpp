#include "reference/trace/parallel_sight.h"

#include "reference/exact/norms.h"
#include "reference/trace/plane_edges.h"
#include "scenes/roundoff.h"

#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

/// A line of sight in the view's sheared coordinates, the same all along it but for the height,
/// which falls with the depth. Its direction is the one that the shear follows, but slopes are
/// rounded: the errors of shear.h hold at its start, and those of a triangle's corners cover the
/// way to them.
ApproximateDirection place_of(const OriginView& view, const glm::dvec3& line) {
    const Shear& shear = view.shear;
    const glm::dvec3 q = line - view.origin; // off by u
    const double z = q[shear.axes[2]] * view.scale;
    const auto sheared = [&](std::size_t k, double slope) {
        return q[shear.axes[k]] * view.scale - slope * z;
    };
    // 2 e + 4.1 u m.
    return {{sheared(0, shear.slope_u), sheared(1, shear.slope_v), 1},
            7 * double_roundoff * largest(q) * view.scale};
}

} // namespace

// The start's height is off by u of its distance, the way down by u of itself, and their difference
// by u of both.
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

void look_along(const Tracer::State& state, const Vectors& lines, std::uint32_t lanes,
                const SeenRange& range, RayPacket& packet) {
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const glm::dvec3 line = lines[static_cast<std::size_t>(lane)];
        const auto [near_lo, near_hi] = heights_at(state, line, range.near, 0);
        HitLimits limits{.lower_lo = -std::numeric_limits<float>::infinity(),
                         .lower_hi = -std::numeric_limits<float>::infinity(),
                         .upper_lo = float_below(near_lo),
                         .upper_hi = float_above(near_hi)};
        if (std::isfinite(range.far)) {
            const auto [far_lo, far_hi] = heights_at(state, line, range.far, 0);
            limits.lower_lo = float_below(far_lo);
            limits.lower_hi = float_above(far_hi);
        }
        set_lane(packet, lane, place_of(state.from_eye, line), limits, no_plane);
    }
}

} // namespace shadowproof
