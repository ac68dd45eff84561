// Vectors known within bounds: a box, component by component, a distance in any direction, and a
// rotation. If two vectors point the same way, rotating one by a little changes their dot product
// far less than moving it.
#pragma once

#include "compare/driver/interval.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

/// Every vector within `distance` of a rotated vector of the box. The rotation moves a unit vector
/// by up to `turn`.
struct VectorRange {
    Intervals box{};
    double distance = 0;
    double turn = 0;
};

inline double width(const Interval& a) {
    return a.high - a.low;
}
inline Intervals widened(const Intervals& a, double by) {
    return {widened(a[0], by), widened(a[1], by), widened(a[2], by)};
}
inline Intervals operator+(const Intervals& a, const Intervals& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// Length of the longest vector in a box.
inline double longest(const Intervals& box) {
    double square = 0;
    for (const Interval& a : box) {
        const double size = std::max(std::abs(a.low), std::abs(a.high));
        square += size * size;
    }
    return std::sqrt(square);
}

/// How far from its box a range reaches.
inline double reach(const VectorRange& a) {
    return a.turn > 0 ? a.distance + a.turn * longest(a.box) : a.distance;
}
inline Intervals box_around(const VectorRange& a) {
    return widened(a.box, reach(a));
}
inline VectorRange hull(const VectorRange& a, const VectorRange& b) {
    return {hull(a.box, b.box), std::max(a.distance, b.distance), std::max(a.turn, b.turn)};
}
inline VectorRange operator+(const VectorRange& a, const VectorRange& b) {
    return {a.box + b.box, reach(a) + reach(b)};
}

/// How far the middle of a box is from its corners.
inline double half_diagonal(const Intervals& a) {
    const glm::dvec3 widths(width(a[0]), width(a[1]), width(a[2]));
    return widths == glm::dvec3(0) ? 0 : 0.5 * glm::length(widths);
}
/// Largest distance of a vector in the range from the range's middle.
inline double radius(const VectorRange& a) {
    return half_diagonal(a.box) + reach(a);
}

/// A rotation that moves a unit vector by c changes its product with another vector, of length l
/// and at the angle p, by at most c l sin p + c^2 / 2 l; if both are rotated, c is the sum. A
/// distance changes it by at most that distance times the other's length (Cauchy-Schwarz).
inline Interval dot(const VectorRange& a, const VectorRange& b) {
    const double turn = a.turn + b.turn;
    const double distance = a.distance + b.distance;
    const Interval product = dot(a.box, b.box);
    if (turn == 0 && distance == 0) return product;
    const double a_length = longest(a.box);
    const double b_length = longest(b.box);
    double off = a.distance * b_length + b.distance * a_length + a.distance * b.distance;
    if (turn > 0) {
        const double across = glm::length(glm::cross(middle(a.box), middle(b.box))) +
                              half_diagonal(a.box) * b_length + half_diagonal(b.box) * a_length;
        off += turn * across + 0.5 * turn * turn * a_length * b_length;
    }
    return widened(product, off);
}

/// Largest distance of two vectors after normalising them, if they were apart by `share` of the
/// one's length: the chord of the angle whose sine is `share`. From 1 on, any distance is possible.
inline double turned_by(double share) {
    if (!(share < 1)) return 2;
    return share * std::sqrt(2 / (1 + std::sqrt(1 - share * share)));
}

/// The vectors normalised; a vector of length zero becomes z.
inline VectorRange unit(const VectorRange& a) {
    const glm::dvec3 vector = middle(a.box);
    const double length = glm::length(vector);
    const double off = radius(a);
    if (!(length > 0)) return {around(glm::dvec3(0, 0, 1)), 0, off > 0 ? 2.0 : 0.0};
    return {around(vector / length), 0, off > 0 ? turned_by(off / length) : 0.0};
}

} // namespace shadowproof
