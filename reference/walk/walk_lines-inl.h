// Cutting rays to the scene's box, for sixteen lanes at once; compiled by each file that includes
// it for each instruction set (see Highway's own -inl.h files for the guard).
#if defined(SHADOWPROOF_REFERENCE_WALK_LINES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SHADOWPROOF_REFERENCE_WALK_LINES_INL
#undef SHADOWPROOF_REFERENCE_WALK_LINES_INL
#else
#define SHADOWPROOF_REFERENCE_WALK_LINES_INL
#endif

#include "reference/walk/double_lanes-inl.h"
#include "reference/walk/walk_lines.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {

/// Rays of some lanes: p + s w, for s from begin to end.
struct WalkLine {
    Number p[3]; // NOLINT: vectors may not lie in std::array
    Number w[3]; // NOLINT
    Number begin;
    Number end;
};

/// The farthest that lines may begin from the scene's centre for cut_lanes to divide in float: then
/// sides of the box are misplaced by less than 2^-21 of 514.
inline constexpr double near_scene = 512;

/// As cut_to_scene, for the lanes from the i-th on. `near`: all begin within near_scene.
inline void cut_lanes(const WalkLine& line, bool near, WalkRays& rays, Lanes<double>& start,
                      std::size_t i) {
    // Half the side of the box: that of all clusters which are not outlying, and more than any line
    // may be off by (BoxTrees), so that no true line meets the scene where this one misses the box.
    constexpr double box = 1.5;
    Number enter = line.begin;
    Number leave = line.end;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // A line that moves less than 2^-70 is between the sides all the way, or beside them.
        const Number w = line.w[axis];
        const Number least = number(0x1p-70);
        const Number moves = hn::IfThenElse(hn::Lt(hn::Abs(w), least), least, w);
        const Number inverse =
            near ? hn::PromoteTo(doubles, hn::Div(hn::Set(floats, 1), hn::DemoteTo(floats, moves)))
                 : hn::Div(number(1), moves);
        const Number a = hn::Mul(hn::Sub(number(-box), line.p[axis]), inverse);
        const Number b = hn::Mul(hn::Sub(number(box), line.p[axis]), inverse);
        enter = hn::Max(enter, hn::Min(a, b));
        leave = hn::Min(leave, hn::Max(a, b));
    }
    const auto misses = hn::Not(hn::Le(enter, leave));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Number w = line.w[axis];
        const Number at = hn::Add(line.p[axis], hn::Mul(enter, w));
        const Number within = hn::Min(hn::Max(at, number(-2)), number(2));
        // Where it misses: outside all boxes but those that hold everything, and short.
        store(hn::IfThenElse(misses, number(2), within), rays.start[axis], i);
        // Embree's coherent packets may lose boxes where some component is between this and 0
        // (docs/how-it-decides.md); made +0, which Embree takes for 1e-18, it is harmless.
        const auto dangerous = hn::And(hn::Lt(w, number(0)), hn::Gt(w, number(-1.0001e-18)));
        store(hn::IfThenElse(dangerous, number(0), w), rays.way[axis], i);
    }
    const Number length = hn::IfThenElse(misses, number(0), hn::Sub(leave, enter));
    store(hn::Add(hn::Mul(length, number(1 + 0x1p-20)), number(0x1p-20)), rays.far, i);
    store(hn::IfThenElse(misses, line.begin, enter), start, i);
}

} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
