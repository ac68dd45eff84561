#include "reference/exact/predicates.h"

#include "reference/exact/bounded.h"
#include "reference/exact/exact.h"
#include "reference/exact/formulas.h"

#include <optional>

namespace shadowproof {

namespace {

using namespace formulas;

std::optional<int> sign_of(const Bounded& number) {
    return number.sign();
}
int sign_of(const Limbs& number) {
    return number.sign();
}
int sign_of(const Dyadic& number) {
    return number.sign();
}

/// `formula(arithmetic)` returns the number, or the product of numbers as a sign, that is wanted;
/// it is written once and evaluated with as much precision as it needs. Limbs are for formulas of
/// degree 6 with inputs within their range (exact.h).
template <class Formula>
Decision decide(Filters filters, const Formula& formula, bool by_limbs = true) {
    if (filters == Filters::on)
        if (const std::optional<int> sign = formula(BoundedArithmetic{}))
            return {*sign, *sign == 0 ? Exactness::degenerate : Exactness::filtered};
    int sign = 0;
    bool left_range = !by_limbs;
    if (by_limbs) sign = *formula(LimbsArithmetic{&left_range});
    if (left_range) sign = *formula(DyadicArithmetic{});
    return {sign, sign == 0 ? Exactness::degenerate : Exactness::exact};
}

/// Sign of value / denominator's sign, where both are certain.
template <class N>
std::optional<int> with_sign_of(const N& value, const N& denominator) {
    const std::optional<int> v = sign_of(value);
    const std::optional<int> d = sign_of(denominator);
    if (!v || !d) return std::nullopt;
    return *v * (*d < 0 ? -1 : 1);
}

std::optional<int> opposite(const std::optional<int>& sign) {
    return sign ? std::optional(-*sign) : std::nullopt;
}

bool is_at_infinity(const RayPoint& q) {
    return q.kind == RayPoint::Kind::infinity || q.kind == RayPoint::Kind::eye;
}

/// Sign of (E - origin + (n / d) D) . plane, the plane's normal given: d (E - origin) . plane +
/// n D . plane, with d made positive.
template <class A>
std::optional<int> point_against(const A& arithmetic, const EyeRay& ray, const RayPoint& q,
                                 const glm::dvec3& origin, const Vector<A>& plane) {
    const Number<A> along = dot<A>(direction_of(arithmetic, ray), plane);
    if (q.kind == RayPoint::Kind::infinity) return sign_of(along);
    if (q.kind == RayPoint::Kind::eye) return opposite(sign_of(along));
    const Number<A> base = dot<A>(difference(arithmetic, ray.start, origin), plane);
    const Quotient<A> t = position(arithmetic, ray, q);
    return with_sign_of(t.denominator * base + t.numerator * along, t.denominator);
}

/// The side of a plane to which the move (e, e^2, e^3), e -> 0, takes a point on it: that of the
/// first component of the plane's normal that is not zero.
template <class NormalOf>
Decision moved_against(Filters filters, const NormalOf& normal_of) {
    Decision moved;
    for (int axis = 0; axis < 3 && moved.sign == 0; ++axis)
        moved = decide(filters, [&]<class A>(const A& arithmetic) -> std::optional<int> {
            const Vector<A> n = normal_of(arithmetic);
            return sign_of(axis == 0 ? n.x : (axis == 1 ? n.y : n.z));
        });
    return {moved.sign, Exactness::degenerate};
}

/// The same for a point of a ray.
template <class NormalOf>
Decision moved_against(Filters filters, const RayPoint& q, const NormalOf& normal_of) {
    Decision moved = moved_against(filters, normal_of);
    if (q.kind == RayPoint::Kind::eye) moved.sign = -moved.sign;
    return moved;
}

} // namespace

Decision Predicates::side(const glm::dvec4& o, const Corners& t) const {
    return decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        return sign_of(dot<A>(away_from(arithmetic, o, t.a), normal(arithmetic, t)));
    });
}

Decision Predicates::edge(const EyeRay& ray, const glm::dvec3& a, const glm::dvec3& b) const {
    return decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        return sign_of(dot<A>(direction_of(arithmetic, ray),
                              edge_plane(arithmetic, glm::dvec4(ray.start, 1), a, b)));
    });
}

Decision Predicates::depth_order(const EyeRay& ray, const Corners& t, const Corners& u) const {
    return decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        const Quotient<A> p = plane_depth(arithmetic, ray, t);
        const Quotient<A> q = plane_depth(arithmetic, ray, u);
        const std::optional<int> order =
            with_sign_of(p.numerator * q.denominator - q.numerator * p.denominator, p.denominator);
        const std::optional<int> d = sign_of(q.denominator);
        if (!order || !d) return std::nullopt;
        return *order * (*d < 0 ? -1 : 1);
    });
}

Decision Predicates::depth_against(const EyeRay& ray, const Corners& t, double depth) const {
    return decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        const Quotient<A> p = plane_depth(arithmetic, ray, t);
        return with_sign_of(p.numerator - arithmetic.number(depth) * p.denominator, p.denominator);
    });
}

Decision Predicates::shadow_edge(const EyeRay& ray, const RayPoint& q, const glm::dvec3& a,
                                 const glm::dvec3& b) const {
    return decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        const Vector<A> plane = edge_plane(arithmetic, ray.light, a, b);
        if (ray.light.w != 0)
            return point_against<A>(arithmetic, ray, q, glm::dvec3(ray.light), plane);
        const std::optional<int> sign = point_against<A>(arithmetic, ray, q, a, plane);
        if (!is_at_infinity(q) || sign != 0) return sign;
        // The ray is parallel to the plane: the side is that of its start.
        return sign_of(dot<A>(difference(arithmetic, ray.start, a), plane));
    });
}

Decision Predicates::shadow_edge_untied(const EyeRay& ray, const RayPoint& q, const glm::dvec3& a,
                                        const glm::dvec3& b) const {
    const Decision tied = shadow_edge(ray, q, a, b);
    if (tied.sign != 0) return tied;
    // Not all three are zero: otherwise light, a and b would be collinear, and the light would lie
    // in the plane of the triangle, which then takes no part.
    return moved_against(filters_, q, [&]<class A>(const A& arithmetic) {
        return edge_plane(arithmetic, ray.light, a, b);
    });
}

Decision Predicates::towards_shadow_edge_untied(const EyeRay& ray, const glm::dvec3& a,
                                                const glm::dvec3& b) const {
    const auto plane = [&]<class A>(const A& arithmetic) {
        return edge_plane(arithmetic, ray.light, a, b);
    };
    const Decision tied = decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        return sign_of(dot<A>(direction_of(arithmetic, ray), plane(arithmetic)));
    });
    return tied.sign != 0 ? tied : moved_against(filters_, plane);
}

Decision Predicates::side_of_point(const EyeRay& ray, const RayPoint& q, const Corners& u) const {
    return decide(filters_, [&]<class A>(const A& arithmetic) -> std::optional<int> {
        return point_against<A>(arithmetic, ray, q, u.a, normal(arithmetic, u));
    });
}

Decision Predicates::side_of_point_untied(const EyeRay& ray, const RayPoint& q,
                                          const Corners& u) const {
    const Decision tied = side_of_point(ray, q, u);
    if (tied.sign != 0) return tied;
    return moved_against(filters_, q,
                         [&]<class A>(const A& arithmetic) { return normal(arithmetic, u); });
}

bool Predicates::runs_from_light(const EyeRay& ray) const {
    const auto sign = [&](const auto& component) {
        return decide(filters_,
                      [&]<class A>(const A& arithmetic) -> std::optional<int> {
                          const Vector<A> d = direction_of(arithmetic, ray);
                          return sign_of(component(d, vector(arithmetic, glm::dvec3(ray.light))));
                      })
            .sign;
    };
    return sign([](const auto& d, const auto& l) { return d.y * l.z - d.z * l.y; }) == 0 &&
           sign([](const auto& d, const auto& l) { return d.z * l.x - d.x * l.z; }) == 0 &&
           sign([](const auto& d, const auto& l) { return d.x * l.y - d.y * l.x; }) == 0 &&
           sign([](const auto& d, const auto& l) { return d.x * l.x + d.y * l.y + d.z * l.z; }) < 0;
}

// With Q = E + (n / d) D, d made positive, and v = d (E - apex) + n D = d (Q - apex): where v .
// axis and the cosine differ in sign that decides, else it is the sign of (v . axis)^2 - cosine^2 v
// . v, negated where both are negative.
Decision Predicates::within_cone(const EyeRay& ray, const RayPoint& q, const Cone& cone) const {
    return decide(
        filters_,
        [&]<class A>(const A& arithmetic) -> std::optional<int> {
            const Quotient<A> t = position(arithmetic, ray, q);
            const Vector<A> base = difference(arithmetic, ray.start, cone.apex);
            const Vector<A> d = direction_of(arithmetic, ray);
            const Vector<A> v{t.denominator * base.x + t.numerator * d.x,
                              t.denominator * base.y + t.numerator * d.y,
                              t.denominator * base.z + t.numerator * d.z};
            const Number<A> along = dot<A>(v, vector(arithmetic, cone.axis));
            const Number<A> cosine = arithmetic.number(cone.cosine);
            const std::optional<int> side = with_sign_of(along, t.denominator);
            const std::optional<int> squares =
                sign_of(along * along - cosine * cosine * dot<A>(v, v));
            if (!side) return std::nullopt;
            if (cone.cosine >= 0) return *side < 0 ? std::optional(-1) : squares;
            if (*side >= 0) return 1;
            return squares ? std::optional(-*squares) : std::nullopt;
        },
        false);
}

} // namespace shadowproof
