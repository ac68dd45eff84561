#include "compare/traced/float_bounds.h"

#include "reference/exact/norms.h"
#include "reference/trace/state.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double u = float_roundoff;
/// Terms of at most this do not overflow: at most two of them are added (U + V), and rounding makes
/// none twice as large.
constexpr double largest_term = std::numeric_limits<float>::max() / 4;
/// Embree drops triangles with larger coordinates: its FLT_LARGE is 1.844e18.
constexpr double largest_coordinate = 1.8e18;
/// What a product of floats loses at most where it underflows.
constexpr double half_of_smallest = std::numeric_limits<float>::denorm_min() / 2.0;

/// What underflow takes from a number (see Numbers) whose cross product is multiplied by factors of
/// the sum `by`: from each component of the cross product two products' loss, times the factor;
/// from each of the dot product's three products, and from a product with near or far, one. Sums
/// lose nothing. Twice, for the rounding of all that.
double lost_below(double by) {
    return 2 * half_of_smallest * (4 + 2 * by);
}

/// Bounds of |a x b|, component by component, and of its rounding errors if times a few u.
glm::dvec3 size_of_cross(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 p = glm::abs(a);
    const glm::dvec3 q = glm::abs(b);
    return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

/// The numbers that Embree computes and compares (Moeller & Trumbore 1997, Fast, Minimum Storage
/// Ray/Triangle Intersection): with e1 = a - b, e2 = c - a, C = a - o and N = e2 x e1 these are
/// den = N . d, U = (C x d) . e2, V = (C x d) . e1 and T = N . C, the last three with the sign of
/// den. The ray meets the triangle if U >= 0, V >= 0, U + V <= |den| and near |den| < T <= far
/// |den|. Here they are computed in double, whose own rounding is nothing beside the bounds.
///
/// Of each number every term is a product of three factors. C, e1 and e2 are differences, rounded
/// once; products, the two sums of a cross product's and a dot product's terms are rounded once
/// each. The term that passes most of them has in U and V: C 1, product 1, difference 1, e 1,
/// product 1, sums 2, together 7 u of its size; in den: 2 for both edges, 1, 1, 1, 2: 7; in T one
/// more: 8. U + V and |den| near, |den| far are rounded once again: 9. The sum of the terms'
/// sizes times 10 u bounds that and second order. Fused operations round less.
struct Numbers {
    double den, u_, v, t;
    glm::dvec3 to_a, e1, e2, direction;

    Numbers(const AnyRay& ray, const Corners& corners)
        : to_a(corners.a - ray.origin), e1(corners.a - corners.b), e2(corners.c - corners.a),
          direction(ray.direction) {
        const glm::dvec3 normal = glm::cross(e2, e1);
        const glm::dvec3 around = glm::cross(to_a, direction);
        den = glm::dot(normal, direction);
        u_ = glm::dot(around, e2);
        v = glm::dot(around, e1);
        t = glm::dot(normal, to_a);
        if (den < 0) {
            den = -den;
            u_ = -u_;
            v = -v;
            t = -t;
        }
    }
};

struct Bounds {
    double den, u_, v, t;

    /// From sums of components: larger than the others, and cheap.
    static Bounds coarse(const Numbers& n) {
        const double edge1 = sum_of(n.e1);
        const double edge2 = sum_of(n.e2);
        const double around = sum_of(n.to_a) * sum_of(n.direction);
        const auto bound = [](double size, double by) {
            return 10 * u * size * by + lost_below(by);
        };
        return {bound(edge1 * edge2, sum_of(n.direction)), bound(around, edge2),
                bound(around, edge1), bound(edge1 * edge2, sum_of(n.to_a))};
    }
    static Bounds fine(const Numbers& n) {
        const glm::dvec3 normal = size_of_cross(n.e2, n.e1);
        const glm::dvec3 around = size_of_cross(n.to_a, n.direction);
        const auto bound = [](const glm::dvec3& sizes, const glm::dvec3& by) {
            return 10 * u * glm::dot(sizes, glm::abs(by)) + lost_below(sum_of(by));
        };
        return {bound(normal, n.direction), bound(around, n.e2), bound(around, n.e1),
                bound(normal, n.to_a)};
    }
};

Meeting within(double number, double error) {
    if (number > error) return Meeting::always;
    return number < -error ? Meeting::never : Meeting::perhaps;
}

Meeting decided(const Numbers& n, const Bounds& b, const AnyRay& ray) {
    // Where the sign of den is uncertain, so are those of the others: but U and V must agree.
    if (!(n.den > b.den)) {
        const bool apart = within(n.u_, b.u_) != Meeting::perhaps &&
                           within(n.v, b.v) != Meeting::perhaps && (n.u_ > 0) != (n.v > 0);
        const double beyond = std::abs(n.u_ + n.v) - n.den;
        return apart || beyond > b.u_ + b.v + b.den ? Meeting::never : Meeting::perhaps;
    }
    Meeting all = std::min({within(n.u_, b.u_), within(n.v, b.v),
                            within(n.den - n.u_ - n.v, b.u_ + b.v + b.den),
                            within(n.t - ray.near * n.den, b.t + ray.near * b.den)});
    if (!std::isinf(ray.far))
        all = std::min(all, within(ray.far * n.den - n.t, b.t + ray.far * b.den));
    return all;
}

/// Whether some product that Embree computes may be too large for a float.
bool may_overflow(const Numbers& n, const Corners& t, const AnyRay& ray) {
    const double area = sum_of(n.e1) * sum_of(n.e2);
    const double longer = std::max({sum_of(n.e1), sum_of(n.e2), 1.0});
    const double aside = sum_of(n.to_a) * sum_of(n.direction);
    const double limit = std::isinf(ray.far) ? 1 : std::max(ray.far, 1.0);
    return std::max({area, area * sum_of(n.direction) * limit, area * sum_of(n.to_a),
                     aside * longer}) > largest_term ||
           std::max({largest(t.a), largest(t.b), largest(t.c)}) > largest_coordinate;
}

/// Whether the traversal reaches the triangle: whether the ray meets its box. Boxes further up
/// enclose it, and rounding keeps that order, so that they are met if it is. The two sides of one
/// axis keep their order as well: a box without thickness is lost to other axes alone.
Meeting box_meeting(const AnyRay& ray, const Corners& t, const glm::dvec3& enlargement) {
    const glm::dvec3 lower = glm::min(glm::min(t.a, t.b), t.c);
    const glm::dvec3 upper = glm::max(glm::max(t.a, t.b), t.c);
    std::array<double, 3> enter{};
    std::array<double, 3> leave{};
    std::array<double, 3> error{};
    for (int axis = 0; axis < 3; ++axis) {
        const double d = ray.direction[axis];
        const double inverse = std::abs(d) < least_component ? 1 / least_component : 1 / d;
        const double a = (lower[axis] - ray.origin[axis]) * inverse;
        const double b = (upper[axis] - ray.origin[axis]) * inverse;
        const auto i = static_cast<std::size_t>(axis);
        enter[i] = std::min(a, b);
        leave[i] = std::max(a, b);
        error[i] = enlargement[axis] * std::abs(inverse);
    }
    Meeting met = Meeting::always;
    for (std::size_t i = 0; i < 3; ++i) {
        met = std::min(
            {met, within(leave[i] - ray.near, error[i]), within(ray.far - enter[i], error[i])});
        for (std::size_t k = 0; k < 3; ++k)
            if (i != k) met = std::min(met, within(leave[k] - enter[i], error[i] + error[k]));
    }
    return met;
}

/// U / |den| and V / |den| by a reciprocal: at most 8 u for that. First order is doubled for the
/// rest, as long as the divisor is known well.
glm::dvec2 weight_errors(const Numbers& n, const Bounds& b, bool overflow) {
    if (overflow || !(n.den > 8 * b.den))
        return glm::dvec2(std::numeric_limits<double>::infinity());
    const auto error = [&](double number, double bound) {
        const double weight = std::abs(number / n.den);
        return 2 * (bound / n.den + weight * (b.den / n.den + 8 * u));
    };
    return {error(n.u_, b.u_), error(n.v, b.v)};
}

} // namespace

FloatMeeting float_meeting(const AnyRay& ray, const Corners& t, const glm::dvec3& enlargement) {
    const Numbers numbers(ray, t);
    Meeting meeting = decided(numbers, Bounds::coarse(numbers), ray);
    const bool overflow = may_overflow(numbers, t, ray);
    if (meeting == Meeting::never && !overflow) return {};
    const Bounds bounds = Bounds::fine(numbers);
    meeting = overflow ? Meeting::perhaps : decided(numbers, bounds, ray);
    if (meeting == Meeting::never) return {};
    // A leaf's triangles are compared together, even those whose own boxes are missed: a box that
    // is missed proves nothing.
    if (box_meeting(ray, t, enlargement) != Meeting::always) meeting = Meeting::perhaps;
    // t = T / |den| by a reciprocal: at most 8 u for that. First order is doubled for the rest.
    const double relative = bounds.t / std::abs(numbers.t) + bounds.den / numbers.den + 8 * u;
    const double at = numbers.t / numbers.den;
    const double error = relative < 0.125 && !overflow ? 2 * relative * std::abs(at)
                                                       : std::numeric_limits<double>::infinity();
    return {meeting, at, error, weight_errors(numbers, bounds, overflow)};
}

// The weights of the corners, one of which is 1 less the others, round six times together, products
// and sums included; places among the texels four times, of coordinates up to 2 (float_mask.cpp);
// alpha, up to 1, three times a difference, a product and a sum, of which two follow each other.
FloatMeeting float_meeting(const Tracer& tracer, const AnyRay& ray, std::uint32_t triangle,
                           const glm::dvec3& enlargement) {
    FloatMeeting met = float_meeting(ray, corners(tracer.scene(), triangle), enlargement);
    if (met.meeting == Meeting::never || !tracer.state().has_mask(triangle)) return met;
    const MaskedTriangle masked = tracer.state().masked(triangle);
    const auto& [a, b, c] = masked.at;
    MaskError error{.alpha = 6 * u};
    error.at = met.weight_error.x * glm::abs(b - a) + met.weight_error.y * glm::abs(c - a) +
               6 * u * (glm::abs(a) + glm::abs(b) + glm::abs(c)) + 4 * 2 * u;
    const EyeRay exact{ray.origin, ray.direction, {}};
    if (!may_stand_on_ray(exact, masked, error, MaskReading::most)) return {};
    if (!may_stand_on_ray(exact, masked, error, MaskReading::least)) met.meeting = Meeting::perhaps;
    return met;
}

} // namespace shadowproof
