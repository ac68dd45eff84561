#include "reference/trace/packet.h"

#include "reference/exact/norms.h"

#include <algorithm>
#include <bit>
#include <cmath>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/packet.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, packet_size>;
using Ids = hn::RebindToUnsigned<Floats>;
using Vector = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

enum class Query : std::uint8_t { nearest, any, count };

constexpr Floats floats;
constexpr Ids ids;

int step() {
    return static_cast<int>(hn::Lanes(floats));
}

std::uint32_t bits_of(Mask mask, int first_lane) {
    alignas(8) std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(floats, mask, bytes.data());
    return (static_cast<std::uint32_t>(bytes[0]) | (static_cast<std::uint32_t>(bytes[1]) << 8U))
           << static_cast<unsigned>(first_lane);
}

Vector load(const Lanes<float>& values, int i) {
    return hn::Load(floats, values.data() + i);
}

// The float ray must meet every box, enlarged by pad, that the exact ray meets. A hit lies within
// the scene, so s |w| <= 1 there (scaled coordinates, |w| the exact ray's). Each component of w is
// off by a relative 2^-24, which meets_box allows for, and by `error`: s error <= error / |w| <=
// error of pad, as |w| >= 1; twice that, because |w| is itself off. Components below 2^-31 |w| are
// made +0: another 2^-31 of pad, which leaves 2^-31 of the 2^-30 given, so that a box really met
// reaches that far to either side of the plane through the origin, and 2^100 for 1/w then lies
// beyond every s. Where nothing is known of the direction, any will do: a pad of 4 lets all boxes
// (at most 1 away) hold the ray's start, and every triangle is decided exactly.
void prepare(RayPacket& packet) {
    const Vector one = hn::Set(floats, 1);
    const Vector infinite = hn::Set(floats, std::numeric_limits<float>::infinity());
    Vector pad = hn::Set(floats, 0x1p-30F);
    for (int i = 0; i < packet_size; i += step()) {
        Vector x = load(packet.x, i);
        Vector y = load(packet.y, i);
        Vector z = load(packet.z, i);
        const Vector size = hn::Max(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
        const Vector still = hn::Mul(size, hn::Set(floats, 0x1p-31F));
        const auto set_axis = [&](Vector w, Lanes<float>& component, Lanes<float>& reciprocal) {
            const Mask moves = hn::Ge(hn::Abs(w), still);
            hn::Store(hn::IfThenElseZero(moves, w), floats, component.data() + i);
            hn::Store(hn::IfThenElse(moves, hn::Div(one, w), hn::Set(floats, 0x1p100F)), floats,
                      reciprocal.data() + i);
        };
        set_axis(x, packet.x, packet.rx);
        set_axis(y, packet.y, packet.ry);
        set_axis(z, packet.z, packet.rz);
        const Vector error = load(packet.error, i);
        pad = hn::Max(pad, hn::MulAdd(error, hn::Set(floats, 2), hn::Set(floats, 0x1p-30F)));
        hn::Store(
            hn::IfThenElse(hn::Gt(error, hn::Set(floats, packet.trusted_error)), infinite, size),
            floats, packet.magnitude.data() + i);
        const Vector unit = load(packet.unit, i);
        for (Lanes<float>* limit :
             {&packet.lower_lo, &packet.lower_hi, &packet.upper_lo, &packet.upper_hi})
            hn::Store(hn::Mul(load(*limit, i), unit), floats, limit->data() + i);
        const Vector awake = load(packet.farthest, i);
        const Vector farthest =
            hn::Mul(hn::Div(one, load(packet.lower_lo, i)), hn::Set(floats, 1 + 0x1p-20F));
        hn::Store(hn::IfThenElse(hn::Lt(awake, hn::Zero(floats)), awake, farthest), floats,
                  packet.farthest.data() + i);
    }
    packet.pad = std::min(4.0F, hn::GetLane(hn::MaxOfLanes(floats, pad)));
}

// Parallel rays. u and v are off by 2^-24 of rounding to float, and by `error` as w is: the pad has
// twice that, error over w's third component, and 2^-21 where |u| <= 2 (2^-23 twice, and the 2^-50
// that the boxes, of at most 1, may be too small); further out no box lies. Of an unknown direction
// all boxes are met.
void prepare_parallel(RayPacket& packet) {
    const Vector infinite = hn::Set(floats, std::numeric_limits<float>::infinity());
    Vector pad = hn::Set(floats, 0x1p-21F);
    for (int i = 0; i < packet_size; i += step()) {
        const Vector x = load(packet.x, i);
        const Vector y = load(packet.y, i);
        const Mask awake = hn::Ge(load(packet.farthest, i), hn::Zero(floats));
        const Vector z = hn::IfThenElse(awake, load(packet.z, i), hn::Set(floats, 1));
        const Vector unit = load(packet.unit, i);
        const Vector error = load(packet.error, i);
        pad = hn::Max(pad,
                      hn::MulAdd(hn::Div(error, z), hn::Set(floats, 2), hn::Set(floats, 0x1p-21F)));
        hn::Store(hn::Div(x, z), floats, packet.rx.data() + i);
        hn::Store(hn::Div(y, z), floats, packet.ry.data() + i);
        hn::Store(load(packet.lower_lo, i), floats, packet.rz.data() + i);
        const Vector size = hn::Max(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
        hn::Store(
            hn::IfThenElse(hn::Gt(error, hn::Set(floats, packet.trusted_error)), infinite, size),
            floats, packet.magnitude.data() + i);
        for (Lanes<float>* limit :
             {&packet.lower_lo, &packet.lower_hi, &packet.upper_lo, &packet.upper_hi})
            hn::Store(hn::Mul(load(*limit, i), unit), floats, limit->data() + i);
    }
    packet.pad = hn::GetLane(hn::MaxOfLanes(floats, pad));
}

// Does any lane's ray pass through the box, at a height that counts?
bool meets_ground(const RayPacket& packet, const Entry& box) {
    const float pad = packet.pad;
    const Vector left = hn::Set(floats, box.lower[0] - pad);
    const Vector right = hn::Set(floats, box.upper[0] + pad);
    const Vector front = hn::Set(floats, box.lower[1] - pad);
    const Vector back = hn::Set(floats, box.upper[1] + pad);
    const Vector top = hn::Set(floats, box.upper[2] + pad);
    for (int i = 0; i < packet_size; i += step()) {
        const Vector u = load(packet.rx, i);
        const Vector v = load(packet.ry, i);
        const Mask within = hn::And(hn::And(hn::Ge(u, left), hn::Le(u, right)),
                                    hn::And(hn::Ge(v, front), hn::Le(v, back)));
        const Mask awake = hn::Ge(load(packet.farthest, i), hn::Zero(floats));
        const Mask below = hn::Le(load(packet.rz, i), top);
        if (!hn::AllFalse(floats, hn::And(within, hn::And(awake, below)))) return true;
    }
    return false;
}

// Does any lane's ray meet the box? The plane x = p is reached at s = p / w_x. In float that is
// p' r with p' = p - pad, r = 1/w_x and w_x each rounded, and the product rounded: 4 roundings, so
// entry and exit are right to within a factor 1 +- 4.01 2^-24, and signs are right. 1 + 2^-20
// covers both, and that of `farthest`.
bool meets_box(const RayPacket& packet, const Entry& box) {
    const Vector grown = hn::Set(floats, 1 + 0x1p-20F);
    const float pad = packet.pad;
    const auto slab = [&](std::size_t axis, const Lanes<float>& reciprocal, int i, Vector& entry,
                          Vector& exit) {
        const Vector r = load(reciprocal, i);
        const Vector a = hn::Mul(hn::Set(floats, box.lower[axis] - pad), r);
        const Vector b = hn::Mul(hn::Set(floats, box.upper[axis] + pad), r);
        entry = hn::Max(entry, hn::Min(a, b));
        exit = hn::Min(exit, hn::Max(a, b));
    };
    for (int i = 0; i < packet_size; i += step()) {
        Vector entry = hn::Zero(floats);
        Vector exit = load(packet.farthest, i);
        slab(0, packet.rx, i, entry, exit);
        slab(1, packet.ry, i, entry, exit);
        slab(2, packet.rz, i, entry, exit);
        if (!hn::AllFalse(floats, hn::Le(entry, hn::Mul(exit, grown)))) return true;
    }
    return false;
}

/// What floats tell of one triangle for some lanes. Neither certain: undecided.
struct Answer {
    Mask met;
    Mask undecided;
    Vector lo; ///< 1/s lies in [lo, hi]
    Vector hi;
};

/// w . n for one triangle's n of a cluster.
Vector dot(const RayPacket& packet, int i, const std::array<PerTriangle<float>, 3>& n,
           std::size_t triangle) {
    return hn::Add(hn::Add(hn::Mul(load(packet.x, i), hn::Set(floats, n[0][triangle])),
                           hn::Mul(load(packet.y, i), hn::Set(floats, n[1][triangle]))),
                   hn::Mul(load(packet.z, i), hn::Set(floats, n[2][triangle])));
}

/// Comparisons with NaN are false, so whatever overflows is undecided.
Answer test(const RayPacket& packet, int i, const ClusterRecord& cluster, std::size_t t) {
    const Vector magnitude = load(packet.magnitude, i);
    const Vector inner =
        hn::Min(hn::Min(dot(packet, i, cluster.edge[0], t), dot(packet, i, cluster.edge[1], t)),
                dot(packet, i, cluster.edge[2], t));
    Answer answer;
    const Mask maybe_inside = hn::Not(hn::Lt(inner, hn::Neg(magnitude)));
    if (hn::AllFalse(floats, maybe_inside)) {
        answer.met = answer.undecided = maybe_inside;
        answer.lo = answer.hi = inner;
        return answer;
    }
    const Vector tolerance = hn::Mul(magnitude, hn::Set(floats, cluster.inverse_tolerance[t]));
    const Vector inverse = dot(packet, i, cluster.inverse, t);
    answer.lo = hn::Sub(inverse, tolerance);
    answer.hi = hn::Add(inverse, tolerance);
    const Mask awake = hn::Ge(load(packet.farthest, i), hn::Zero(floats));
    const Mask skipped = hn::RebindMask(
        floats, hn::Eq(hn::Load(ids, packet.skip.data() + i), hn::Set(ids, cluster.plane[t])));
    const Mask out = hn::Or(hn::Lt(answer.hi, load(packet.lower_lo, i)),
                            hn::Gt(answer.lo, load(packet.upper_hi, i)));
    const Mask candidate = hn::And(hn::AndNot(out, maybe_inside), hn::AndNot(skipped, awake));
    answer.met = hn::And(hn::And(candidate, hn::Ge(inner, magnitude)),
                         hn::And(hn::Gt(answer.lo, load(packet.lower_hi, i)),
                                 hn::Lt(answer.hi, load(packet.upper_lo, i))));
    answer.undecided = hn::AndNot(answer.met, candidate);
    return answer;
}

void keep_nearest(RayPacket& packet, int i, const Answer& answer, std::uint32_t triangle) {
    const auto blend = [&](Lanes<float>& values, Vector value) {
        hn::BlendedStore(value, answer.met, floats, values.data() + i);
    };
    blend(packet.lower_lo, answer.lo);
    blend(packet.lower_hi, answer.hi);
    blend(packet.farthest,
          hn::Mul(hn::Div(hn::Set(floats, 1), answer.lo), hn::Set(floats, 1 + 0x1p-20F)));
    hn::BlendedStore(hn::Set(ids, triangle), hn::RebindMask(ids, answer.met), ids,
                     packet.hit.data() + i);
}

template <Query query>
void meet_triangle(RayPacket& packet, const ClusterRecord& cluster, std::size_t t,
                   Arbiter& arbiter) {
    const std::uint32_t triangle = cluster.triangle[t];
    for (int i = 0; i < packet_size; i += step()) {
        const Answer answer = test(packet, i, cluster, t);
        if (!hn::AllFalse(floats, answer.met)) {
            if constexpr (query == Query::nearest) {
                keep_nearest(packet, i, answer, triangle);
            } else {
                for (std::uint32_t left = bits_of(answer.met, i); left != 0; left &= left - 1) {
                    const int lane = __builtin_ctz(left);
                    const auto l = static_cast<std::size_t>(lane);
                    if constexpr (query == Query::count) {
                        packet.crossed[l] += cluster.copies[t];
                    } else {
                        packet.hit[l] = triangle;
                        finish_lane(packet, lane);
                    }
                }
            }
        }
        if (hn::AllFalse(floats, answer.undecided)) continue;
        for (std::uint32_t left = bits_of(answer.undecided, i); left != 0; left &= left - 1)
            arbiter.decide(packet, __builtin_ctz(left), triangle);
    }
}

/// At each level one of two children stays on the stack; a leaf of triangles with one box has up to
/// 4 clusters.
constexpr std::size_t stack_size = deepest_level + 4;

template <Query query, bool parallel>
void traverse(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    if constexpr (parallel)
        prepare_parallel(packet);
    else
        prepare(packet);
    const std::vector<Entry>& entries = records.view().entries;
    std::array<std::uint32_t, stack_size> stack; // NOLINT: filled as it is used
    stack[0] = 0;
    for (std::size_t size = 1; size > 0 && packet.active != 0;) {
        const Entry& entry = entries[stack[--size]];
        if (!(parallel ? meets_ground(packet, entry) : meets_box(packet, entry))) continue;
        // Nearest first, so pushed last.
        for (std::uint32_t i = entry.count; i > 0; --i) stack[size++] = entry.first + i - 1;
        if (entry.count > 0) continue;
        const ClusterRecord& cluster = records.of(entry.first);
        for (std::uint32_t i = 0; i < cluster.count; ++i)
            meet_triangle<query>(packet, cluster, i, arbiter);
    }
}

template <Query query>
void traverse(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    if (records.view().parallel)
        traverse<query, true>(packet, records, arbiter);
    else
        traverse<query, false>(packet, records, arbiter);
}

void find_nearest(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    traverse<Query::nearest, false>(packet, records, arbiter);
}
void find_any(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    traverse<Query::any>(packet, records, arbiter);
}
void count_all(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    traverse<Query::count>(packet, records, arbiter);
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(find_nearest);
HWY_EXPORT(find_any);
HWY_EXPORT(count_all);
} // namespace

void find_nearest(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(find_nearest)(packet, records, arbiter);
}
void find_any(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(find_any)(packet, records, arbiter);
}
void count_all(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(count_all)(packet, records, arbiter);
}

RayPacket empty_packet(Filters filters) {
    RayPacket packet;
    if (filters == Filters::off) packet.trusted_error = -1;
    packet.farthest.fill(-1);
    packet.hit.fill(no_triangle);
    packet.skip.fill(no_plane);
    return packet;
}

namespace {

/// 2^-e for a normal size in [2^e, 2^(e + 1)).
double power_that_normalises(double size) {
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(size) >> 52U;
    return std::bit_cast<double>((2046 - exponent) << 52U);
}

} // namespace

void set_lane(RayPacket& packet, int lane, const ApproximateDirection& w, const HitLimits& limits,
              std::uint32_t skip) {
    const auto l = static_cast<std::size_t>(lane);
    const double size = largest(w.direction);
    // Beyond 2^+-100 the limits, which are scaled alike, would leave the range of floats.
    const bool known = size > 0x1p-100 && size < 0x1p100 && w.error < size;
    // Powers of two only: 1 <= |w| < 2 afterwards.
    const double shrink = known ? power_that_normalises(size) : 1;
    packet.x[l] = known ? static_cast<float>(w.direction.x * shrink) : 1.0F;
    packet.y[l] = known ? static_cast<float>(w.direction.y * shrink) : 1.0F;
    packet.z[l] = known ? static_cast<float>(w.direction.z * shrink) : 1.0F;
    // Rounded to float, and a little up.
    packet.error[l] = known ? static_cast<float>(w.error * shrink * (1 + 0x1p-20))
                            : std::numeric_limits<float>::infinity();
    packet.unit[l] = static_cast<float>(shrink);
    packet.lower_lo[l] = limits.lower_lo;
    packet.lower_hi[l] = limits.lower_hi;
    packet.upper_lo[l] = limits.upper_lo;
    packet.upper_hi[l] = limits.upper_hi;
    packet.farthest[l] = 0;
    packet.skip[l] = skip;
    packet.active |= 1U << static_cast<unsigned>(lane);
}

void finish_lane(RayPacket& packet, int lane) {
    packet.farthest[static_cast<std::size_t>(lane)] = -1;
    packet.active &= ~(1U << static_cast<unsigned>(lane));
}

void raise_lower_limit(RayPacket& packet, int lane, float lo, float hi) {
    const auto l = static_cast<std::size_t>(lane);
    packet.lower_lo[l] = lo * packet.unit[l];
    packet.lower_hi[l] = hi * packet.unit[l];
    packet.farthest[l] = 1 / packet.lower_lo[l] * (1 + 0x1p-20F);
}

} // namespace shadowproof
#endif
