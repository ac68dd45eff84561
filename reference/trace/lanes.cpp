#include "reference/trace/lanes.h"

#include "reference/exact/bounded.h"
#include "reference/exact/norms.h"

#include <cmath>
#include <limits>
#include <utility>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/lanes.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, packet_size>;
using Vector = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;

constexpr Doubles doubles;

int step() {
    return static_cast<int>(hn::Lanes(doubles));
}

std::uint32_t bits_of(Mask mask, int first_lane) {
    alignas(8) std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(doubles, mask, bytes.data());
    return static_cast<std::uint32_t>(bytes[0]) << static_cast<unsigned>(first_lane);
}

Vector load(const Lanes<double>& values, int i) {
    return hn::Load(doubles, values.data() + i);
}

// Of two values of which one is no number, the second is kept, so that a product beyond the range
// of doubles cuts nothing off.
Vector larger(Vector a, Vector b) {
    return hn::IfThenElse(hn::Gt(a, b), a, b);
}
Vector smaller(Vector a, Vector b) {
    return hn::IfThenElse(hn::Lt(a, b), a, b);
}

std::uint32_t near_box(const AnyRays& rays, const Slabs& slabs, const Box& box) {
    std::uint32_t met = 0;
    for (int i = 0; i < packet_size; i += step()) {
        Vector enter = load(rays.near, i);
        Vector leave = load(rays.far, i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vector origin = load(rays.origin[axis], i);
            const Vector inverse = load(slabs.inverse[axis], i);
            const Vector margin = load(slabs.margin[axis], i);
            const auto met_at = [&](double plane) {
                return hn::Mul(hn::Sub(hn::Set(doubles, plane), origin), inverse);
            };
            const Vector a = met_at(double{box.lower[static_cast<int>(axis)]});
            const Vector b = met_at(double{box.upper[static_cast<int>(axis)]});
            enter = larger(hn::Sub(smaller(a, b), margin), enter);
            leave = smaller(hn::Add(larger(a, b), margin), leave);
        }
        met |= bits_of(hn::Le(enter, leave), i);
    }
    return met;
}

// The signs of D . ((a - E) x e), as Predicates::edge has them. Each of the six products of three
// factors has its two differences rounded, two products, the difference of two of them, and two
// sums: 7 u; the eighth is for the bound's own rounding. Their sum is at most that of the
// components of D times that of a - E times the largest of e. What is added for underflow is far
// above what it can take. A product beyond the range of doubles leaves no finite value. `share`: of
// the products of sizes. One bit per lane: above, and below.
std::pair<std::uint32_t, std::uint32_t> edge_signs(const AnyRays& rays, const glm::dvec3& a,
                                                   const glm::dvec3& e, double share) {
    const Vector ex = hn::Set(doubles, e.x);
    const Vector ey = hn::Set(doubles, e.y);
    const Vector ez = hn::Set(doubles, e.z);
    const Vector most = hn::Set(doubles, std::numeric_limits<double>::max());
    std::uint32_t above = 0;
    std::uint32_t below = 0;
    for (int i = 0; i < packet_size; i += step()) {
        const Vector wx = hn::Sub(hn::Set(doubles, a.x), load(rays.origin[0], i));
        const Vector wy = hn::Sub(hn::Set(doubles, a.y), load(rays.origin[1], i));
        const Vector wz = hn::Sub(hn::Set(doubles, a.z), load(rays.origin[2], i));
        const Vector dx = load(rays.direction[0], i);
        const Vector dy = load(rays.direction[1], i);
        const Vector dz = load(rays.direction[2], i);
        const Vector d = hn::Add(hn::Add(hn::Abs(dx), hn::Abs(dy)), hn::Abs(dz));
        const Vector w = hn::Add(hn::Add(hn::Abs(wx), hn::Abs(wy)), hn::Abs(wz));
        const auto minor = [](Vector p, Vector q, Vector r, Vector s) {
            return hn::Sub(hn::Mul(p, q), hn::Mul(r, s));
        };
        const Vector value =
            hn::Add(hn::Add(hn::Mul(dx, minor(wy, ez, wz, ey)), hn::Mul(dy, minor(wz, ex, wx, ez))),
                    hn::Mul(dz, minor(wx, ey, wy, ex)));
        const Vector error =
            hn::Add(hn::Mul(hn::Mul(hn::Set(doubles, share), d), w),
                    hn::Mul(hn::Set(doubles, Bounded::underflow), hn::Add(hn::Set(doubles, 1), d)));
        above |= bits_of(hn::And(hn::Gt(value, error), hn::Le(value, most)), i);
        below |= bits_of(hn::And(hn::Lt(value, hn::Neg(error)), hn::Ge(value, hn::Neg(most))), i);
    }
    return {above, below};
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {

HWY_EXPORT(near_box);
HWY_EXPORT(edge_signs);

/// One bit per lane whose sign is certain.
struct CertainSigns {
    std::uint32_t above = 0;
    std::uint32_t below = 0;
};
CertainSigns signs_at(const AnyRays& rays, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 e = b - a;
    const auto [above, below] =
        HWY_DYNAMIC_DISPATCH(edge_signs)(rays, a, e, 8 * double_roundoff * largest(e));
    return {above, below};
}

} // namespace

void set_slabs(Slabs& slabs, int lane, const AnyRay& ray, const glm::dvec3& enlargement) {
    const auto l = static_cast<std::size_t>(lane);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = ray.direction[static_cast<int>(axis)];
        const double inverse = std::abs(d) < least_component ? 1 / least_component : 1 / d;
        slabs.inverse[axis][l] = inverse;
        slabs.margin[axis][l] = enlargement[static_cast<int>(axis)] * std::abs(inverse);
    }
}

std::uint32_t lanes_near(const AnyRays& rays, const Slabs& slabs, const Box& box) {
    return HWY_DYNAMIC_DISPATCH(near_box)(rays, slabs, box) & rays.lanes;
}

LanesBeside lanes_beside(const AnyRays& rays, const Corners& t) {
    const CertainSigns ab = signs_at(rays, t.a, t.b);
    const CertainSigns bc = signs_at(rays, t.b, t.c);
    const std::uint32_t beside = (ab.above | bc.above) & (ab.below | bc.below);
    if ((rays.lanes & ~beside) == 0) return {0, beside};
    const CertainSigns ca = signs_at(rays, t.c, t.a);
    return {(ab.above & bc.above & ca.above) | (ab.below & bc.below & ca.below),
            (ab.above | bc.above | ca.above) & (ab.below | bc.below | ca.below)};
}

} // namespace shadowproof
#endif
