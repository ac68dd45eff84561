// Logarithms and powers as raster/glsl/lighting/powers.glsl computes them, as ranges.
#pragma once

#include "compare/driver/interval.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shadowproof {

/// Error of log2_of(x), of a result r: t has the roundings of its sum and of the quotient, which a
/// driver may make with two (3 v); the polynomial in t^2 its last sum's and product's and less of
/// those before, of which t^2 shrinks all (4 v), and what is left out after t^9 (0.1 v); two
/// products and a constant (3 v). Together 10.1 v of at most a half, and v of r.
inline double log2_error(double result) {
    return (6 + std::abs(result)) * float_roundoff;
}

/// Relative error of exp2_of(x), of a number x that is exact: that of the place's product with a
/// constant (2 v of 0.35), of the last two sums and products (3 v), of what they are made of (v),
/// and what is left out after the seventh power (0.1 v).
inline constexpr double exp2_error = 5 * float_roundoff;

/// Below this exp2_of is 0.
inline constexpr double least_exponent = -126;

/// 2^x for x that is off by up to `off`.
inline Interval exp2_range(const Interval& x, double off) {
    const auto power = [](double at) { return at < least_exponent ? 0 : std::exp2(at); };
    return {power(x.low - off) * (1 - exp2_error), power(x.high + off) * (1 + exp2_error)};
}

/// x^y for x up to about 1 and y of 0 or more, as power_of makes it of exact numbers in these
/// ranges.
inline Interval power_range(const Interval& x, const Interval& y) {
    constexpr double least = float_underflow;
    if (!(x.high > least)) return {0, 0};
    const auto exponent = [](double base, double power) {
        const double log = std::log2(base);
        const double off = power * log2_error(log) + float_roundoff * std::abs(power * log);
        return around(power * log, off);
    };
    const Interval high = hull(exponent(x.high, y.low), exponent(x.high, y.high));
    Interval whole = high;
    if (x.low > least) whole = hull(whole, hull(exponent(x.low, y.low), exponent(x.low, y.high)));
    Interval power = exp2_range(whole, 0);
    if (!(x.low > least)) power.low = 0;
    return power;
}

} // namespace shadowproof
