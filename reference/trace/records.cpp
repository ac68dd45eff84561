#include "reference/trace/records.h"

#include "scenes/roundoff.h"

#include <limits>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/records.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, cluster_capacity>;
using Floats = hn::Rebind<float, Doubles>;
using Number = hn::Vec<Doubles>;

constexpr Doubles doubles;
constexpr Floats floats;
constexpr double u = double_roundoff; ///< rounding unit of double
constexpr double v = float_roundoff;

Number number(double x) {
    return hn::Set(doubles, x);
}

struct Vector {
    Number x, y, z;
};

Vector minus(const Vector& p, const Vector& q) {
    return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
Vector times(const Vector& p, Number s) {
    return {hn::Mul(p.x, s), hn::Mul(p.y, s), hn::Mul(p.z, s)};
}
Vector cross(const Vector& p, const Vector& q) {
    return {hn::Sub(hn::Mul(p.y, q.z), hn::Mul(p.z, q.y)),
            hn::Sub(hn::Mul(p.z, q.x), hn::Mul(p.x, q.z)),
            hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x))};
}
Number dot(const Vector& p, const Vector& q) {
    return hn::Add(hn::Add(hn::Mul(p.x, q.x), hn::Mul(p.y, q.y)), hn::Mul(p.z, q.z));
}
Number largest(const Vector& p) {
    return hn::Max(hn::Max(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
}
Number largest(const Vector& p, const Vector& q, const Vector& r) {
    return hn::Max(hn::Max(largest(p), largest(q)), largest(r));
}
template <class Mask>
Vector choose(Mask mask, const Vector& p, const Vector& otherwise) {
    return {hn::IfThenElse(mask, p.x, otherwise.x), hn::IfThenElse(mask, p.y, otherwise.y),
            hn::IfThenElse(mask, p.z, otherwise.z)};
}
Number sum_of(const Vector& p) {
    return hn::Add(hn::Add(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
}

/// World-space corners of a cluster's triangles from the i-th on, oriented so that det > 0: those
/// whose bit in `front` is set have their second and third exchanged.
struct ClusterCorners {
    Vector a, b, c;

    ClusterCorners(const Cluster& cluster, std::uint32_t front, std::size_t i) {
        const auto corner = [&](std::size_t k) {
            const auto axis = [&](std::size_t n) {
                return hn::PromoteTo(doubles, hn::Load(floats, cluster.corner[k][n].data() + i));
            };
            return Vector{axis(0), axis(1), axis(2)};
        };
        const std::array<std::uint8_t, 8> bits{static_cast<std::uint8_t>(front >> i)};
        const auto exchanged = hn::LoadMaskBits(doubles, bits.data());
        const Vector second = corner(1);
        const Vector third = corner(2);
        a = corner(0);
        b = choose(exchanged, third, second);
        c = choose(exchanged, second, third);
    }
    const Vector& operator[](std::size_t k) const { return k == 0 ? a : (k == 1 ? b : c); }
};

void store(Number value, PerTriangle<float>& to, std::size_t i) {
    hn::Store(hn::DemoteTo(floats, value), floats, to.data() + i);
}
void store(const Vector& value, std::array<PerTriangle<float>, 3>& to, std::size_t i) {
    store(value.x, to[0], i);
    store(value.y, to[1], i);
    store(value.z, to[2], i);
}

// The bound of a float dot product w . N, N known in double to within e per component.
//   w: its float differs from the true direction by v |w_i| of rounding, and by at most v |w| / 2
//      of error in the surface point it leads to (otherwise prepare(), rays.cpp, makes |w|
//      infinite);
//   N: its float by v |N_i| + e;
//   the products and two sums: 3 roundings.
// To first order |w| ((3 + 1 + 1.5) v |N|_1 + 3 e). 7 v covers second order, and that threshold and
// |w| are floats themselves. A float that underflows is off by less than 2^-126, which 2^-100
// covers, as 1 <= |w|. What is returned is grown by more than its conversion to float can take.
Number tolerance(Number size, Number component_error) {
    const Number bound =
        hn::Add(hn::Add(hn::Mul(number(7 * v), size), hn::Mul(number(3.1), component_error)),
                number(0x1p-100));
    return hn::Mul(bound, number(1 + 0x1p-21));
}

/// Stores w . N divided by its tolerance, so that each edge has its own: next to a light on one
/// edge the others still tell what is outside. Where `nothing_known`, 0, from which nothing
/// follows. What underflows is by 2^-126 and more below the tolerance of 1.
template <class Mask>
void store_edge(const Vector& edge, Number component_error, Mask nothing_known,
                std::array<PerTriangle<float>, 3>& to, std::size_t i) {
    // The quotient of floats is off by three roundings at the most, less than `tolerance` allows.
    const auto size = hn::DemoteTo(floats, tolerance(sum_of(edge), component_error));
    const Number share = hn::PromoteTo(doubles, hn::Div(hn::Set(floats, 1), size));
    store(times(edge, hn::IfThenElse(nothing_known, number(0), share)), to, i);
}

/// A tolerance; infinite, so that nothing is certain, where `nothing_known`.
template <class Mask>
Number unless(Mask nothing_known, Number tolerance) {
    return hn::IfThenElse(nothing_known, number(std::numeric_limits<double>::infinity()),
                          tolerance);
}

// Triangles as parallel rays see them. With m <= 1/2 the largest coordinate relative to the origin,
// l that of an edge, and |lean| <= 2^-9 (shear.h), in units of u:
//   a difference of coordinates is off by m (of an edge by l), a slope by 3 of itself, so that
//   x - slope z, at most 2 m, is off by m + (1 + 3 + 1) m + 2 m + second order = 8.1 m;
//   the divisor, within 2^-10 of 1, by 1.1;
//   u and v, at most 2.01 m, by 8.1 m + 2.01 m (1.1 + 1) = 12.4 m; h, at most 1.01 m, by 3.2 m;
//   of an edge, u_b - u_a = (D + u_a lean dz) / (1 - lean b_z), where D = dx - slope dz is at most
//   2 l and off by 8.1 l, and the second term, at most 2^-9 l, by a fiftieth l: at most 2.02 l, and
//   off by 8.2 l + 2.02 l (sum) + 2.02 l (1.1 + 1) = 14.5 l;
//   h_b - h_a = dz / ((1 - lean a_z) (1 - lean b_z)), at most 1.01 l, is off by l + 1.01 l (3.3 +
//   1) = 5.4 l.
// Of a directional light lean is 0, and all is off by less.
void make_parallel_records(const OriginView& view, const Cluster& cluster, std::uint32_t front,
                           ClusterRecord& record) {
    const std::array<int, 3>& axes = view.shear.axes;
    const Vector origin{number(view.origin[axes[0]]), number(view.origin[axes[1]]),
                        number(view.origin[axes[2]])};
    const Number scale = number(view.scale);
    const Number lean = number(view.shear.lean);
    const Number up = number(view.shear.up);
    const auto slant = [&](const Vector& p) {
        return Vector{hn::Sub(p.x, hn::Mul(number(view.shear.slope_u), p.z)),
                      hn::Sub(p.y, hn::Mul(number(view.shear.slope_v), p.z)), hn::Mul(up, p.z)};
    };
    for (std::size_t i = 0; i < cluster_capacity; i += hn::Lanes(doubles)) {
        const ClusterCorners corners(cluster, front, i);
        const auto world = [&](std::size_t k) {
            const std::array<Number, 3> p{corners[k].x, corners[k].y, corners[k].z};
            return Vector{p[static_cast<std::size_t>(axes[0])],
                          p[static_cast<std::size_t>(axes[1])],
                          p[static_cast<std::size_t>(axes[2])]};
        };
        const auto relative = [&](const Vector& p, const Vector& q) {
            return times(minus(p, q), scale);
        };
        const Vector edges_as_given[3] = {relative(world(1), world(0)),
                                          relative(world(2), world(1)),
                                          relative(world(0), world(2))};
        const Vector places[3] = {relative(world(0), origin), relative(world(1), origin),
                                  relative(world(2), origin)};
        const Number l = largest(edges_as_given[0], edges_as_given[1], edges_as_given[2]);
        const Number ll = hn::Mul(l, l);
        const auto outlying = hn::Gt(largest(places[0], places[1], places[2]), number(0.5));
        const auto divisor_of = [&](std::size_t k) {
            return hn::Sub(number(1), hn::Mul(lean, places[k].z));
        };
        const auto mapped = [&](std::size_t k) {
            const Vector p = slant(places[k]);
            const Number divisor = divisor_of(k);
            return Vector{hn::Div(p.x, divisor), hn::Div(p.y, divisor), hn::Div(p.z, divisor)};
        };
        const auto mapped_edge = [&](std::size_t k, const Vector& from) {
            const Vector d = slant(edges_as_given[k]);
            const Number turn = hn::Mul(lean, edges_as_given[k].z);
            const Number divisor = divisor_of((k + 1) % 3);
            return Vector{hn::Div(hn::Add(d.x, hn::Mul(from.x, turn)), divisor),
                          hn::Div(hn::Add(d.y, hn::Mul(from.y, turn)), divisor),
                          hn::Div(d.z, hn::Mul(divisor_of(k), divisor))};
        };

        // a x (b - a) with a = (u, v, 1): of the third component each product is off by 2.01 m
        // 14.5 l + 2.02 l 12.4 m + 4.1 m l = 58.4 m l, their difference by twice that and 8.2 m l:
        // 125 m l <= 63 l.
        const Number edge_error = hn::Mul(number(64 * u), l);
        Vector along[3];
        const Vector a = mapped(0);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector from = k == 0 ? a : mapped(k);
            along[k] = mapped_edge(k, from);
            const Vector edge{hn::Neg(along[k].y), along[k].x,
                              hn::Sub(hn::Mul(from.x, along[k].y), hn::Mul(from.y, along[k].x))};
            store_edge(edge, edge_error, outlying, record.edge[k], i);
        }

        // n = (b - a) x (c - b). n_h, made of u and v alone, is at most 8.2 l^2; each product is
        // off by 2 2.02 14.5 + 4.1 = 62.7, so n_h by 2 62.7 + 8.2 = 134 l^2. Of the others, one
        // factor is an h: at most 4.1 l^2, products off by 1.01 14.5 + 2.02 5.4 + 2.1 = 27.7, each
        // by 2 27.7 + 4.1 = 60 l^2. n . a: twice 4.1 12.4 + 2.01 60 + 8.3 = 180, once 8.2 3.2 +
        // 1.01 134 + 8.3 = 170, the sums, of 16.6 and 24.9, 42: 572 m l^2 <= 286 l^2.
        const Vector normal = cross(along[0], along[1]);
        const Number det = normal.z;
        const Number det_error = hn::Mul(number(136 * u), ll);
        const Number numerator_error = hn::Mul(number(290 * u), ll);
        // The plane's height over (u, v) is (n . a - n_u u - n_v v) / n_h; as for points.
        const Number reciprocal = hn::Div(number(1), det);
        const Vector inverse =
            times({hn::Neg(normal.x), hn::Neg(normal.y), dot(normal, a)}, reciprocal);
        const Number extent = largest(inverse);
        const Number inverse_error = hn::Add(
            hn::Mul(hn::Add(numerator_error, hn::Mul(number(1.4), hn::Mul(extent, det_error))),
                    reciprocal),
            hn::Mul(number(2.1 * u), extent));
        store(inverse, record.inverse, i);
        const auto uncertain = hn::Not(hn::Gt(det, hn::Mul(number(4), det_error)));
        store(unless(hn::Or(outlying, uncertain), tolerance(sum_of(inverse), inverse_error)),
              record.inverse_tolerance, i);
    }
}

void make_records(const OriginView& view, const Cluster& cluster, std::uint32_t front,
                  ClusterRecord& record) {
    if (view.parallel) return make_parallel_records(view, cluster, front, record);
    const Vector origin{number(view.origin.x), number(view.origin.y), number(view.origin.z)};
    const Number scale = number(view.scale);
    for (std::size_t i = 0; i < cluster_capacity; i += hn::Lanes(doubles)) {
        const ClusterCorners world(cluster, front, i);
        const Vector a = times(minus(world[0], origin), scale);
        const Vector b = times(minus(world[1], origin), scale);
        const Vector c = times(minus(world[2], origin), scale);
        const Vector ab = times(minus(world[1], world[0]), scale);
        const Vector bc = times(minus(world[2], world[1]), scale);
        const Vector ca = times(minus(world[0], world[2]), scale);
        const Number m = largest(a, b, c);
        const Number l = largest(ab, bc, ca);
        const Number ll = hn::Mul(l, l);
        const auto outlying = hn::Gt(m, number(1));

        // Of an edge from a to b, a x (b - a) = b x (b - a): the end that is nearer, at m, says
        // more. Differences are off by u, so each component, two products and a difference, by
        // 4 u (m l + m l).
        const Vector ends[3] = {a, b, c};
        const Vector edges[3] = {ab, bc, ca};
        Number nearest_m = largest(a);
        Vector nearest = a;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector& next = ends[(k + 1) % 3];
            const Number next_m = largest(next);
            const Number end_m = largest(ends[k]);
            const auto is_nearer = hn::Lt(next_m, end_m);
            const Number edge_error =
                hn::Mul(number(8.1 * u), hn::Mul(hn::Min(next_m, end_m), largest(edges[k])));
            store_edge(cross(choose(is_nearer, next, ends[k]), edges[k]), edge_error, outlying,
                       record.edge[k], i);
            nearest = choose(hn::Lt(next_m, nearest_m), next, nearest);
            nearest_m = hn::Min(nearest_m, next_m);
        }

        // As in view.cpp: the normal, (b - a) x (c - b), is off by 8 u l^2 per component, det by 48
        // u m l^2, with m of the corner from which it is computed: the nearest.
        const Vector normal = cross(ab, bc);
        const Number det = dot(nearest, normal);
        const Number det_error = hn::Mul(number(50 * u), hn::Mul(nearest_m, ll));
        // normal / det: the normal's error over det, and its own size times det's relative error,
        // at most 4/3 det_error / det since det may be that much smaller; two roundings.
        const Number reciprocal = hn::Div(number(1), det);
        const Vector inverse = times(normal, reciprocal);
        const Number extent = largest(inverse);
        const Number inverse_error =
            hn::Add(hn::Mul(hn::Add(hn::Mul(number(8.2 * u), ll),
                                    hn::Mul(number(1.4), hn::Mul(extent, det_error))),
                            reciprocal),
                    hn::Mul(number(2.1 * u), extent));
        store(inverse, record.inverse, i);
        const auto uncertain = hn::Not(hn::Gt(det, hn::Mul(number(4), det_error)));
        store(unless(hn::Or(outlying, uncertain), tolerance(sum_of(inverse), inverse_error)),
              record.inverse_tolerance, i);
    }
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {

HWY_EXPORT(make_records);

} // namespace

RecordCache::RecordCache(const OriginView& view, Part part,
                         const std::vector<std::uint8_t>& double_sided,
                         const std::vector<std::uint32_t>* masks)
    : view_(&view), part_(part), double_sided_(&double_sided), masks_(masks) {}

bool RecordCache::takes_part(std::uint32_t triangle) const {
    const std::int8_t side = view_->side[triangle];
    switch (part_) {
    case Part::seen:
        return side < 0 || (side > 0 && (*double_sided_)[triangle] != 0);
    case Part::occluding:
        return side != 0;
    case Part::light_facing:
        break;
    }
    return side < 0;
}

std::uint32_t RecordCache::copies(std::uint32_t triangle) const {
    const Places& places = *view_->places;
    std::uint32_t count = 0;
    for (std::uint32_t i = places.first[triangle]; i != no_triangle; i = places.next[i])
        count += takes_part(i) ? 1 : 0;
    return count;
}

std::uint32_t RecordCache::members_of(const ClusterSides& sides) const {
    switch (part_) {
    case Part::seen:
        return sides.front | (sides.back & sides.double_sided);
    case Part::occluding:
        return sides.front | sides.back;
    case Part::light_facing:
        break;
    }
    return sides.front;
}

std::uint32_t RecordCache::masked_of(const ClusterRecord& record) const {
    if (masks_ == nullptr || masks_->empty()) return 0;
    std::uint32_t masked = 0;
    for (std::uint32_t left = record.members; left != 0; left &= left - 1) {
        const int place = __builtin_ctz(left);
        if ((*masks_)[record.triangle[static_cast<std::size_t>(place)]] != no_mask)
            masked |= 1U << place;
    }
    return masked;
}

/// Of the triangles in one place the first that takes part.
void RecordCache::choose_among_copies(std::uint32_t place, Cluster& chosen, std::uint32_t& front,
                                      ClusterRecord& record) const {
    const std::uint32_t bit = 1U << place;
    std::uint32_t triangle = chosen.triangles[place];
    while (triangle != no_triangle && !takes_part(triangle))
        triangle = view_->places->next[triangle];
    record.members &= ~bit;
    if (triangle == no_triangle) return;
    record.members |= bit;
    front = view_->side[triangle] < 0 ? front | bit : front & ~bit;
    record.triangle[place] = triangle;
    record.copies[place] = copies(triangle);
    record.plane[place] = view_->places->plane[triangle];
    for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
            chosen.corner[static_cast<std::size_t>(k)][static_cast<std::size_t>(axis)][place] =
                static_cast<float>(corner(*view_->scene, triangle, k)[axis]);
}

void RecordCache::fill(Slot& slot, std::uint32_t number) const {
    const Cluster& cluster = view_->trees->clusters().all[number];
    const ClusterSides& sides = view_->clusters[number];
    ClusterRecord& record = slot.record;
    slot.cluster = number;
    record.members = members_of(sides);
    record.triangle = cluster.triangles;
    record.plane = cluster.planes;
    record.copies.fill(1);
    std::uint32_t front = sides.front;
    if (sides.copied == 0) {
        if (record.members == 0) return;
        HWY_DYNAMIC_DISPATCH(make_records)(*view_, cluster, front, record);
    } else {
        Cluster chosen = cluster;
        for (std::uint32_t left = sides.copied; left != 0; left &= left - 1)
            choose_among_copies(static_cast<std::uint32_t>(__builtin_ctz(left)), chosen, front,
                                record);
        HWY_DYNAMIC_DISPATCH(make_records)(*view_, chosen, front, record);
    }
    record.masked = masked_of(record);
}

} // namespace shadowproof
#endif
