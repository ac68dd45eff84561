// Vectors of numbers of any arithmetic (BoundedArithmetic, LimbsArithmetic, DyadicArithmetic), and
// the points and planes that the formulas of predicates are made of.
#pragma once

#include "reference/exact/predicates.h"

namespace shadowproof::formulas {

template <class Arithmetic>
using Number = typename Arithmetic::Number;

template <class Arithmetic>
struct Vector {
    Number<Arithmetic> x, y, z;
};

template <class A>
Vector<A> vector(const A& arithmetic, const glm::dvec3& v) {
    return {arithmetic.number(v.x), arithmetic.number(v.y), arithmetic.number(v.z)};
}

/// That of an eye ray.
template <class A>
Vector<A> direction_of(const A& arithmetic, const EyeRay& ray) {
    return {arithmetic.direction(ray.direction.x), arithmetic.direction(ray.direction.y),
            arithmetic.direction(ray.direction.z)};
}

template <class A>
Vector<A> difference(const A& arithmetic, const glm::dvec3& v, const glm::dvec3& w) {
    return {arithmetic.difference(v.x, w.x), arithmetic.difference(v.y, w.y),
            arithmetic.difference(v.z, w.z)};
}

template <class A>
Vector<A> cross(const Vector<A>& v, const Vector<A>& w) {
    return {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};
}

template <class A>
Number<A> dot(const Vector<A>& v, const Vector<A>& w) {
    return v.x * w.x + v.y * w.y + v.z * w.z;
}

template <class A>
Vector<A> normal(const A& arithmetic, const Corners& t) {
    return cross<A>(difference(arithmetic, t.b, t.a), difference(arithmetic, t.c, t.a));
}

/// w v - o for a point or a direction O = (o, w).
template <class A>
Vector<A> away_from(const A& arithmetic, const glm::dvec4& o, const glm::dvec3& v) {
    const glm::dvec3 at(o);
    return o.w == 0 ? vector(arithmetic, -at) : difference(arithmetic, v, at);
}

/// (w a - o) x (b - a), the normal of the plane through O and the edge: for a point (a - o) x
/// (b - o), written with the edge because that is short where o is far away.
template <class A>
Vector<A> edge_plane(const A& arithmetic, const glm::dvec4& o, const glm::dvec3& a,
                     const glm::dvec3& b) {
    return cross<A>(away_from(arithmetic, o, a), difference(arithmetic, b, a));
}

/// A point as a quotient that is not divided: Q = E + (numerator / denominator) D.
template <class A>
struct Quotient {
    Number<A> numerator, denominator;
};

/// Where the eye ray meets T's plane: t = (a - E) . N / (D . N).
template <class A>
Quotient<A> plane_depth(const A& arithmetic, const EyeRay& ray, const Corners& t) {
    const Vector<A> n = normal(arithmetic, t);
    return {dot<A>(difference(arithmetic, t.a, ray.start), n),
            dot<A>(direction_of(arithmetic, ray), n)};
}

/// (n, d) of a point: a depth is n / 1, infinity 1 / 0, the eye there -1 / 0. A surface's
/// denominator may be negative.
template <class A>
Quotient<A> position(const A& arithmetic, const EyeRay& ray, const RayPoint& q) {
    switch (q.kind) {
    case RayPoint::Kind::surface:
        return plane_depth(arithmetic, ray, q.surface);
    case RayPoint::Kind::depth:
        return {arithmetic.number(q.depth), arithmetic.number(1)};
    case RayPoint::Kind::eye:
        return {arithmetic.number(-1), arithmetic.number(0)};
    case RayPoint::Kind::infinity:
        break;
    }
    return {arithmetic.number(1), arithmetic.number(0)};
}

} // namespace shadowproof::formulas
