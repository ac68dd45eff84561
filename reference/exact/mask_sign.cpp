#include "reference/exact/mask_sign.h"

#include "reference/exact/bounded.h"
#include "reference/exact/exact.h"
#include "reference/exact/formulas.h"
#include "scenes/surface/alpha_mask.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

using namespace formulas;

/// Proportional to the weights of a triangle's corners at a point of its plane.
template <class A>
using Weights = std::array<Number<A>, 3>;

/// Seen from where the ray starts: the volumes that the ray's direction spans with the edges
/// across. They add up to its product with the triangle's normal.
template <class A>
Weights<A> weights_on_ray(const A& arithmetic, const EyeRay& ray, const Corners& t) {
    const glm::dvec4 start(ray.start, 1);
    const Vector<A> d = direction_of(arithmetic, ray);
    const auto across = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return dot<A>(d, edge_plane(arithmetic, start, a, b));
    };
    return {across(t.b, t.c), across(t.c, t.a), across(t.a, t.b)};
}

/// Seen from the light: the same with the way from the light to Q = E + (n / d) D, times d. Where
/// the light is a direction, the way from the edge to Q has the same volumes.
template <class A>
Weights<A> weights_before_light(const A& arithmetic, const EyeRay& ray, const RayPoint& q,
                                const Corners& t) {
    const Quotient<A> place = position(arithmetic, ray, q);
    const Vector<A> d = direction_of(arithmetic, ray);
    const auto across = [&](const glm::dvec3& a, const glm::dvec3& b) {
        const Vector<A> plane = edge_plane(arithmetic, ray.light, a, b);
        const glm::dvec3 from = ray.light.w != 0 ? glm::dvec3(ray.light) : a;
        return place.denominator * dot<A>(difference(arithmetic, ray.start, from), plane) +
               place.numerator * dot<A>(d, plane);
    };
    return {across(t.b, t.c), across(t.c, t.a), across(t.a, t.b)};
}

template <class A>
Number<A> sum_of(const Weights<A>& weights) {
    return weights[0] + weights[1] + weights[2];
}

/// The weighted sum of the corners' coordinates along one axis; the coordinate, times the weights'
/// sum.
template <class A>
Number<A> weighted(const A& arithmetic, const Weights<A>& weights, const MaskedTriangle& triangle,
                   int axis) {
    return weights[0] * arithmetic.number(triangle.at[0][axis]) +
           weights[1] * arithmetic.number(triangle.at[1][axis]) +
           weights[2] * arithmetic.number(triangle.at[2][axis]);
}

/// The rectangle of coordinates in which the exact ones lie; infinite where doubles cannot tell.
struct Rectangle {
    glm::dvec2 low{-std::numeric_limits<double>::infinity()};
    glm::dvec2 high{std::numeric_limits<double>::infinity()};
};

/// A quotient's error is that of the numerator, and that of the divisor times the quotient, over
/// the least that the divisor may be; and its own rounding.
Rectangle coordinates(const Weights<BoundedArithmetic>& weights, const MaskedTriangle& triangle) {
    const Bounded sum = sum_of<BoundedArithmetic>(weights);
    const double least = std::abs(sum.value) - sum.error;
    if (!(least > 0)) return {};
    Rectangle found;
    for (int axis = 0; axis < 2; ++axis) {
        const Bounded number = weighted(BoundedArithmetic{}, weights, triangle, axis);
        const double value = number.value / sum.value;
        const double error = (number.error + std::abs(value) * sum.error) / least * (1 + 0x1p-50) +
                             2 * double_roundoff * std::abs(value) +
                             std::numeric_limits<double>::min();
        found.low[axis] = value - error;
        found.high[axis] = value + error;
    }
    return found;
}

/// The quotient of two dyadic numbers.
mpq_class quotient(const Dyadic& number, const Dyadic& divisor) {
    mpq_class result(number.mantissa, divisor.mantissa);
    result.canonicalize();
    const long exponent = number.exponent - divisor.exponent;
    if (exponent >= 0) return result << static_cast<mp_bitcnt_t>(exponent);
    return result >> static_cast<mp_bitcnt_t>(-exponent);
}

/// Texels around a place along one axis, and how far it lies from the first to the second.
struct ExactTaps {
    int first = 0;
    int second = 0;
    mpq_class fraction;
};

ExactTaps exact_taps(const AlphaMask& mask, Wrap wrap, int texels, const mpq_class& at) {
    const mpq_class place =
        mask.nearest ? mpq_class(texels * at) : mpq_class(texels * at - mpq_class(1, 2));
    mpz_class floor;
    mpz_fdiv_q(floor.get_mpz_t(), place.get_num_mpz_t(), place.get_den_mpz_t());
    // A period is 2 texels long at most. Clamped, what lies further out is the border's.
    const long period = 2L * texels;
    mpz_class within = floor;
    if (wrap == Wrap::clamp_to_edge) {
        if (within < -1) within = -1;
        if (within > texels) within = texels;
    } else {
        mpz_fdiv_r_ui(within.get_mpz_t(), floor.get_mpz_t(), static_cast<unsigned long>(period));
    }
    const std::int64_t first = within.get_si();
    return {wrapped(wrap, texels, first), wrapped(wrap, texels, first + 1), place - floor};
}

/// Alpha, and whether the texels around are alike, so that it is the same all around.
struct ExactAlpha {
    mpq_class value;
    bool is_flat = false;
};

ExactAlpha exact_alpha(const AlphaMask& mask, const mpq_class& s, const mpq_class& t) {
    const ExactTaps along = exact_taps(mask, mask.wrap_s, mask.alpha.width, s);
    const ExactTaps down = exact_taps(mask, mask.wrap_t, mask.alpha.height, t);
    const auto texel = [&](int x, int y) { return double{mask.alpha.at(x, y)}; };
    const double a = texel(along.first, down.first);
    if (mask.nearest) return {mpq_class(a), true};
    const double b = texel(along.second, down.first);
    const double c = texel(along.first, down.second);
    const double d = texel(along.second, down.second);
    const auto between = [](const mpq_class& p, const mpq_class& q, const mpq_class& share) {
        return mpq_class(p + share * (q - p));
    };
    const mpq_class upper = between(mpq_class(a), mpq_class(b), along.fraction);
    const mpq_class lower = between(mpq_class(c), mpq_class(d), along.fraction);
    return {between(upper, lower, down.fraction), a == b && a == c && a == d};
}

/// `weights(arithmetic)`: of the point.
template <class WeightsOf>
Decision decide(Filters filters, const MaskedTriangle& triangle, const WeightsOf& weights) {
    const AlphaMask& mask = *triangle.mask;
    if (filters == Filters::on) {
        const Rectangle at = coordinates(weights(BoundedArithmetic{}), triangle);
        const AlphaRange alpha = alpha_range(mask, at.low, at.high);
        // All around it is one value.
        if (alpha.low == alpha.high) return {alpha.low < mask.least ? -1 : 1, Exactness::filtered};
        if (alpha.low > mask.least) return {1, Exactness::filtered};
        if (alpha.high < mask.least) return {-1, Exactness::filtered};
    }
    const DyadicArithmetic arithmetic;
    const Weights<DyadicArithmetic> exact = weights(arithmetic);
    const Dyadic sum = sum_of<DyadicArithmetic>(exact);
    if (sum.sign() == 0) return {0, Exactness::degenerate};
    const mpq_class s = quotient(weighted(arithmetic, exact, triangle, 0), sum);
    const mpq_class t = quotient(weighted(arithmetic, exact, triangle, 1), sum);
    const ExactAlpha alpha = exact_alpha(mask, s, t);
    const int order = cmp(alpha.value, mpq_class(mask.least));
    if (order == 0 && !alpha.is_flat) return {0, Exactness::degenerate};
    return {order < 0 ? -1 : 1, Exactness::exact};
}

} // namespace

Decision mask_on_ray(Filters filters, const EyeRay& ray, const MaskedTriangle& triangle) {
    return decide(filters, triangle, [&](const auto& arithmetic) {
        return weights_on_ray(arithmetic, ray, triangle.corners);
    });
}

Decision mask_before_light(Filters filters, const EyeRay& ray, const RayPoint& q,
                           const MaskedTriangle& triangle) {
    return decide(filters, triangle, [&](const auto& arithmetic) {
        return weights_before_light(arithmetic, ray, q, triangle.corners);
    });
}

bool may_stand_on_ray(const EyeRay& ray, const MaskedTriangle& triangle, const MaskError& error,
                      MaskReading reading) {
    const Rectangle at =
        coordinates(weights_on_ray(BoundedArithmetic{}, ray, triangle.corners), triangle);
    const AlphaRange alpha = alpha_range(*triangle.mask, at.low - error.at, at.high + error.at);
    if (alpha.low == alpha.high) return alpha.low >= triangle.mask->least; // nothing is rounded
    return reading == MaskReading::most ? alpha.high + error.alpha >= triangle.mask->least
                                        : alpha.low - error.alpha >= triangle.mask->least;
}

} // namespace shadowproof
