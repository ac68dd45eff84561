#include "reference/trace/walk_lines.h"

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/walk_lines.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, packet_size>;
using Floats = hn::Rebind<float, Doubles>;
using Number = hn::Vec<Doubles>;

constexpr Doubles doubles;
constexpr Floats floats;

Number number(double x) {
    return hn::Set(doubles, x);
}
Number load(const Lanes<double>& values, std::size_t i) {
    return hn::Load(doubles, values.data() + i);
}
void store(Number value, Lanes<float>& to, std::size_t i) {
    hn::Store(hn::DemoteTo(floats, value), floats, to.data() + i);
}

/// Half the side of the box: that of all clusters which are not outlying, and more by far than a
/// line may be off by, so that no true line meets the scene where this one misses the box.
constexpr double box = 1 + 0x1p-10;

void cut_to_scene(const WalkLines& lines, WalkRays& rays, Lanes<double>& start) {
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        Number enter = load(lines.begin, i);
        Number leave = load(lines.end, i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Number p = load(lines.p.axis[axis], i);
            const Number w = load(lines.w.axis[axis], i);
            // A line that moves less than 2^-70 is between the sides all the way, or beside them.
            const Number least = number(0x1p-70);
            const Number inverse =
                hn::Div(number(1), hn::IfThenElse(hn::Lt(hn::Abs(w), least), least, w));
            const Number a = hn::Mul(hn::Sub(number(-box), p), inverse);
            const Number b = hn::Mul(hn::Sub(number(box), p), inverse);
            enter = hn::Max(enter, hn::Min(a, b));
            leave = hn::Min(leave, hn::Max(a, b));
        }
        const auto misses = hn::Not(hn::Le(enter, leave));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Number w = load(lines.w.axis[axis], i);
            const Number at = hn::Add(load(lines.p.axis[axis], i), hn::Mul(enter, w));
            const Number within = hn::Min(hn::Max(at, number(-2)), number(2));
            // Where it misses: outside all boxes but those that hold everything, and short.
            store(hn::IfThenElse(misses, number(1.5), within), rays.start[axis], i);
            // Embree's coherent packets may lose boxes where some component is between this and 0
            // (docs/how-it-decides.md); made +0, which Embree takes for 1e-18, it is harmless.
            const auto dangerous =
                hn::And(hn::Lt(w, number(0)), hn::Gt(w, number(-1.0001e-18)));
            store(hn::IfThenElse(dangerous, number(0), w), rays.way[axis], i);
        }
        const Number length = hn::IfThenElse(misses, number(0), hn::Sub(leave, enter));
        store(hn::Add(hn::Mul(length, number(1 + 0x1p-20)), number(0x1p-20)), rays.far, i);
        hn::Store(hn::IfThenElse(misses, load(lines.begin, i), enter), doubles, start.data() + i);
    }
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(cut_to_scene);
} // namespace

void cut_to_scene(const WalkLines& lines, WalkRays& rays, Lanes<double>& start) {
    HWY_DYNAMIC_DISPATCH(cut_to_scene)(lines, rays, start);
}

} // namespace shadowproof
#endif
