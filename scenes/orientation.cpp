#include "scenes/orientation.h"

#include "scenes/roundoff.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

using Rational = std::array<mpq_class, 3>;

Rational rational(const glm::dvec3& v) {
    return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)};
}

Rational minus(const Rational& p, const Rational& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

Rational cross(const Rational& p, const Rational& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

mpq_class dot(const Rational& p, const Rational& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/// l - w a.
Rational towards(const glm::dvec4& point, const Rational& a) {
    Rational from = rational(glm::dvec3(point));
    const mpq_class w(point.w);
    for (std::size_t i = 0; i < 3; ++i) from[i] -= w * a[i];
    return from;
}

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

constexpr double smallest = std::numeric_limits<double>::min();

/// Error bound of p x q . r, where p, q and r are differences of doubles, rounded to double. With
/// p, q and r their largest components and u = 2^-53: each component of the cross product, two
/// products and a difference, is off by at most 8 u p q, which weighs 3 r in the dot product; that
/// adds 4 u times its three terms of at most 2 p q r: 48 u p q r in all. What underflows is off by
/// at most the smallest double, a few times and up to r times over: by less than the smallest
/// normal one for each unit of r.
double determinant_error(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
    return 50 * double_roundoff * largest(p) * largest(q) * largest(r) +
           smallest * std::max(1.0, largest(r));
}

/// The side of a plane to which the move (e, e^2, e^3), e -> 0, takes a place that lies in it.
int side_of_move(const Rational& normal) {
    for (const mpq_class& component : normal)
        if (const int sign = sgn(component); sign != 0) return sign;
    return 0;
}

} // namespace

double orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec4& point) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 to_point = glm::dvec3(point) - point.w * a;
    const double value = glm::dot(glm::cross(ab, ac), to_point);
    if (std::abs(value) > determinant_error(ab, ac, to_point)) return value;
    if (largest(ab) == 0 || largest(ac) == 0) return 0;
    const Rational from = rational(a);
    const Rational normal = cross(minus(rational(b), from), minus(rational(c), from));
    return sgn(dot(normal, towards(point, from))) * std::max(std::abs(value), smallest);
}

int side_of_edge(const glm::dvec4& light, const glm::dvec3& a, const glm::dvec3& b,
                 const glm::dvec4& place) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 from_light = light.w * a - glm::dvec3(light);
    const glm::dvec3 from_a = glm::dvec3(place) - place.w * a;
    const double value = glm::dot(glm::cross(from_light, ab), from_a);
    if (std::abs(value) > determinant_error(from_light, ab, from_a)) return value > 0 ? 1 : -1;
    const Rational from = rational(a);
    const Rational plane = cross(minus(rational(b), from), towards(light, from));
    if (const int sign = sgn(dot(plane, towards(place, from))); sign != 0) return sign;
    return side_of_move(plane);
}

int side_of_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                     const glm::dvec4& place) {
    const double side = orientation(a, b, c, place);
    if (side != 0) return side > 0 ? 1 : -1;
    const Rational from = rational(a);
    return side_of_move(cross(minus(rational(b), from), minus(rational(c), from)));
}

} // namespace shadowproof
