#include "reference/trace/rays.h"

#include "reference/exact/norms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/rays.cpp"
// The order matters.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "reference/walk/walk_lines-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

using Bits = hn::RebindToUnsigned<Doubles>;
using Mask = hn::Mask<Doubles>;

constexpr Bits bits;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Vector {
    Number x, y, z;
};
Number largest(const Vector& p) {
    return hn::Max(hn::Max(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
}
Vector load_vector(const Vectors& vectors, std::size_t i) {
    return {load(vectors.axis[0], i), load(vectors.axis[1], i), load(vectors.axis[2], i)};
}
void store_vector(const Vector& value, std::array<Lanes<float>, 3>& to, std::size_t i) {
    store(value.x, to[0], i);
    store(value.y, to[1], i);
    store(value.z, to[2], i);
}

Mask mask_of(std::uint32_t lanes, std::size_t first) {
    alignas(8) const std::array<std::uint8_t, 8> bytes{static_cast<std::uint8_t>(lanes >> first)};
    return hn::LoadMaskBits(doubles, bytes.data());
}

/// 2^-e for a normal size in [2^e, 2^(e + 1)).
Number power_that_normalises(Number size) {
    const auto exponent = hn::ShiftRight<52>(hn::BitCast(bits, size));
    return hn::BitCast(doubles, hn::ShiftLeft<52>(hn::Sub(hn::Set(bits, 2046), exponent)));
}

/// A ray's direction with 1 <= |w| < 2, and its error per component, infinite where it is unknown.
struct Direction {
    Vector w;
    Number error;
    Number unit; ///< by which it was multiplied
};

Direction normalised(const RayPacket& packet, std::size_t i) {
    const Vector given = load_vector(packet.direction, i);
    const Number error = load(packet.direction_error, i);
    const Number size = largest(given);
    // Beyond 2^+-100 the limits, which are scaled alike, would leave the range of floats.
    const Mask known =
        hn::And(hn::And(hn::Gt(size, number(0x1p-100)), hn::Lt(size, number(0x1p100))),
                hn::Lt(error, size));
    const Number unit = hn::IfThenElse(known, power_that_normalises(size), number(1));
    const auto known_or_1 = [&](Number x) {
        return hn::IfThenElse(known, hn::Mul(x, unit), number(1));
    };
    return {{known_or_1(given.x), known_or_1(given.y), known_or_1(given.z)},
            hn::IfThenElse(known, hn::Mul(error, unit), number(infinity)),
            unit};
}

/// What the tests of triangles read.
void store_direction(const Direction& of, RayPacket& packet, std::size_t i) {
    store_vector(of.w, packet.w, i);
    store(of.unit, packet.unit, i);
    const Mask trusted = hn::Le(of.error, number(packet.trusted_error));
    store(hn::IfThenElse(trusted, largest(of.w), number(infinity)), packet.magnitude, i);
    for (Lanes<float>* limit :
         {&packet.lower_lo, &packet.lower_hi, &packet.upper_lo, &packet.upper_hi})
        store(hn::Mul(load(*limit, i), of.unit), *limit, i);
}

/// Of the lanes that are active; infinite where it is no number.
Number of_active(const RayPacket& packet, std::size_t i, Number room) {
    const Number known = hn::IfThenElse(hn::Lt(room, number(infinity)), room, number(infinity));
    return hn::IfThenElseZero(mask_of(packet.active, i), known);
}

// From the view's origin O. O in the walk's frame is rounded twice and known to 2^-51 |O|; at s,
// which is at most |O| + 2 in the box, w weighs that much, its error and the rounding of p + s w
// and of s, 2^-50 of all together.
void prepare_from_origin(RayPacket& packet, const OriginView& view) {
    const WalkFrame& frame = view.trees->frame();
    const glm::dvec3 origin = (view.origin - frame.center) * frame.scale;
    const double reach = shadowproof::largest(origin) + 2;
    const Number ratio = number(frame.scale / view.scale);
    Number room = number(0);
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        const Direction of = normalised(packet, i);
        store_direction(of, packet, i);
        // s is the inverse of 1/s: from its upper limit to its lower one, and a little more, as
        // limits are rounded.
        const auto inverse = [&](const Lanes<float>& limit) {
            const auto quotient = hn::Div(hn::Set(floats, 1), hn::Load(floats, limit.data() + i));
            return hn::Mul(ratio, hn::PromoteTo(doubles, quotient));
        };
        const Number begin = hn::Mul(inverse(packet.upper_hi), number(1 - 0x1p-20));
        // A limit of 0, or below by rounding, is none.
        const Number lower = load(packet.lower_lo, i);
        const Number end = hn::IfThenElse(hn::Gt(lower, number(0)),
                                          hn::Mul(inverse(packet.lower_lo), number(1 + 0x1p-20)),
                                          number(infinity));
        cut_lanes({{number(origin.x), number(origin.y), number(origin.z)},
                   {of.w.x, of.w.y, of.w.z},
                   begin,
                   end},
                  reach <= near_scene, packet.walk, packet.walk_start, i);
        const Number off = hn::Mul(number(reach), hn::Add(of.error, number(0x1p-50)));
        room = hn::Max(room, of_active(packet, i, off));
    }
    packet.room = hn::GetLane(hn::MaxOfLanes(doubles, room));
}

// Parallel rays: all points whose sheared coordinates are (u, v). With axes as in shear.h one of
// them is (u, v, 0), and from there the light lies along (slope_u - lean u, slope_v - lean v, 1),
// times `up`. u and v, off by `error`, weigh once and a little; slopes are known to 3 2^-53 of
// themselves. Beyond 2 no box lies. From above, what is walked along is the height with its sign
// changed: from the upper limit to the lower one, 2^-20 further each, as limits are rounded.
void prepare_parallel(RayPacket& packet, const OriginView& view, bool from_above) {
    const Shear& shear = view.shear;
    const double ratio = view.trees->frame().scale / view.scale;
    const Number up = number(from_above ? -shear.up : shear.up);
    const Number lean = number(shear.lean);
    Number room = number(0);
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        const Number w = load(packet.direction.axis[2], i);
        const Number u = hn::Div(load(packet.direction.axis[0], i), w);
        const Number v = hn::Div(load(packet.direction.axis[1], i), w);
        const Number error = hn::Div(load(packet.direction_error, i), w);
        // Where the ray begins, and where it ends.
        const Number height =
            from_above ? hn::Neg(load(packet.upper_hi, i)) : load(packet.lower_lo, i);
        const Number last = from_above ? hn::Neg(load(packet.lower_lo, i)) : number(infinity);
        const Direction of = normalised(packet, i);
        store_direction(of, packet, i);
        const std::array<Number, 3> place{u, v, number(0)};
        const std::array<Number, 3> way{
            hn::Mul(up, hn::Sub(number(shear.slope_u), hn::Mul(lean, u))),
            hn::Mul(up, hn::Sub(number(shear.slope_v), hn::Mul(lean, v))), up};
        std::array<Number, 3> p{};
        std::array<Number, 3> d{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<std::size_t>(shear.axes[k]);
            p[axis] = hn::Mul(place[k], number(ratio));
            d[axis] = way[k];
        }
        // h = up z / (1 - lean z), and up z = s; where that is beyond the light, from anywhere.
        const Number divisor = hn::Add(number(1), hn::Mul(hn::Mul(up, lean), height));
        const Mask from_there = hn::And(hn::Gt(divisor, number(0.5)), hn::Gt(height, number(-4)));
        const Number begin = hn::IfThenElse(
            from_there, hn::Sub(hn::Mul(hn::Div(height, divisor), number(ratio)), number(0x1p-20)),
            number(-infinity));
        const Number most = hn::Max(hn::Abs(u), hn::Abs(v));
        const Mask beside = hn::Gt(hn::Sub(most, error), number(2));
        const Number off = hn::Mul(
            number(2 * ratio), hn::Add(error, hn::Mul(number(0x1p-48), hn::Add(most, number(1)))));
        const auto near_or = [&](Number x, double otherwise) {
            return hn::IfThenElse(beside, number(otherwise), x);
        };
        cut_lanes({{near_or(p[0], 4), near_or(p[1], 4), near_or(p[2], 4)},
                   {near_or(d[0], 1), near_or(d[1], 1), near_or(d[2], 1)},
                   near_or(begin, 0),
                   hn::Add(hn::Mul(last, number(ratio)), number(0x1p-20))},
                  true, packet.walk, packet.walk_start, i);
        room = hn::Max(room, of_active(packet, i, near_or(off, 0)));
    }
    packet.room = hn::GetLane(hn::MaxOfLanes(doubles, room));
}

/// Of the floats that tests compute with.
void find_extremes(RayPacket& packet) {
    constexpr hn::CappedTag<float, packet_size> all;
    const auto no_least = hn::Set(all, std::numeric_limits<float>::infinity());
    auto most_magnitude = hn::Zero(all);
    std::array<hn::Vec<decltype(all)>, 3> least{no_least, no_least, no_least};
    std::array<hn::Vec<decltype(all)>, 3> most{hn::Neg(no_least), hn::Neg(no_least),
                                               hn::Neg(no_least)};
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(all)) {
        const std::uint32_t lanes = packet.active >> i;
        alignas(8) const std::array<std::uint8_t, 8> bytes{static_cast<std::uint8_t>(lanes),
                                                           static_cast<std::uint8_t>(lanes >> 8U)};
        const auto active = hn::LoadMaskBits(all, bytes.data());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto w = hn::Load(all, packet.w[axis].data() + i);
            least[axis] = hn::Min(least[axis], hn::IfThenElse(active, w, no_least));
            most[axis] = hn::Max(most[axis], hn::IfThenElse(active, w, hn::Neg(no_least)));
        }
        most_magnitude = hn::Max(
            most_magnitude, hn::IfThenElseZero(active, hn::Load(all, packet.magnitude.data() + i)));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        packet.least_w[axis] = hn::GetLane(hn::MinOfLanes(all, least[axis]));
        packet.most_w[axis] = hn::GetLane(hn::MaxOfLanes(all, most[axis]));
    }
    packet.most_magnitude = hn::GetLane(hn::MaxOfLanes(all, most_magnitude));
}

void prepare(RayPacket& packet, const OriginView& view, bool from_above) {
    if (view.parallel)
        prepare_parallel(packet, view, from_above);
    else
        prepare_from_origin(packet, view);
    find_extremes(packet);
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(prepare);
} // namespace

void prepare(RayPacket& packet, const OriginView& view, bool from_above) {
    HWY_DYNAMIC_DISPATCH(prepare)(packet, view, from_above);
}

} // namespace shadowproof
#endif
