#include "compare/driver/lighting/filtered_highlight.h"

#include "compare/driver/lighting/powers_range.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// By a share of its size.
Interval rounded_by(const Interval& a, double share) {
    return widened(a, share * size_of(a));
}

/// With n as long as `length`, k = n / (n + s (1 - n)) rises with n: rounded are 1 - n, its
/// product, the sum and the quotient (5 v, as a driver may divide with two). (1 + k s) / (1 + s) is
/// rounded four times more, and the exponent k s once.
Interval toksvig_highlight(const Interval& cosine, const Interval& length, double exponent) {
    const auto kept = [&](double n) { return n / (n + exponent * (1 - n)); };
    const Interval share = rounded_by({kept(length.low), kept(length.high)}, 5 * v);
    const Interval dimmed =
        rounded_by((1 / (1 + exponent)) * (around(1) + exponent * share), 4 * v);
    return dimmed * power_range(cosine, rounded_by(exponent * share, v));
}

/// In the plane of slopes, Gaussian about the mean slope. Its determinant is at least that of the
/// surface between the bumps, own^2, as variances and covariance are those of a mixture: what
/// intervals leave below that is their excess, but for the floats' roundings, of which three are
/// made of either product.
Interval lean_highlight(const Intervals& half, const FilteredBumps& bumps, double exponent) {
    const double own = 1 / exponent;
    const Interval x = rounded_by(bumps.spread[0] + around(own), v);
    const Interval y = rounded_by(bumps.spread[1] + around(own), v);
    const Interval& both = bumps.spread[2];
    const double off = 3 * v * (size_of(x) * size_of(y) + size_of(both) * size_of(both));
    Interval determinant = widened(x * y + -1 * square_of(both), off);
    // The variances themselves are off, each by what its lookups and roundings widened it.
    const double widest = (x.high - x.low) * size_of(y) + (y.high - y.low) * size_of(x) +
                          2 * (both.high - both.low) * size_of(both);
    determinant.low = std::max(determinant.low, own * own - off - widest);
    // The shader makes nothing of one that is not above 0, and of any other at most this.
    if (!(determinant.low > 0)) return {0, own / std::sqrt(float_underflow)};
    const Interval root{std::sqrt(determinant.low) * (1 - v),
                        std::sqrt(determinant.high) * (1 + v)};
    const Interval peak = rounded_by(Interval{own / root.high, own / root.low}, 3 * v);
    if (!(half[2].high > 0)) return {0, 0};
    const auto from_mean = [&](std::size_t k) {
        const Interval shift = half[2] * bumps.slope[k];
        return widened(half[k] + -1 * shift, v * (size_of(half[k]) + 2 * size_of(shift)));
    };
    const Interval dx = from_mean(0);
    const Interval dy = from_mean(1);
    const Interval along_x = y * square_of(dx);
    const Interval along_y = x * square_of(dy);
    const Interval mixed = 2 * (both * (dx * dy));
    // Each of the three has up to three roundings, and two sums follow.
    const double numerator_off = 5 * v * (size_of(along_x) + size_of(along_y) + size_of(mixed));
    const Interval numerator = widened(along_x + -1 * mixed + along_y, numerator_off);
    const double least_z = std::max(half[2].low, 0.0);
    const double most = determinant.high * half[2].high * half[2].high;
    const double least = determinant.low * least_z * least_z;
    const Interval distance{std::max(numerator.low, 0.0) / most,
                            least > 0 ? std::max(numerator.high, 0.0) / least
                                      : std::numeric_limits<double>::infinity()};
    // Rounded are the products below it and the quotient (4 v), the factor and its product (3 v).
    const double half_log = 0.5 * std::numbers::log2e;
    const auto exponent_of = [&](double square_distance) {
        return around(-half_log * square_distance, 7 * v * half_log * std::abs(square_distance));
    };
    Interval fall{0, exp2_range(exponent_of(distance.low), 0).high};
    if (std::isfinite(distance.high)) fall.low = exp2_range(exponent_of(distance.high), 0).low;
    Interval highlight = peak * fall;
    if (!(half[2].low > 0)) highlight.low = 0;
    return highlight;
}

} // namespace

Interval highlight_range(const LightingInputs& in) {
    const Interval cosine = not_negative(dot(in.half, in.bump));
    const double exponent = in.highlight.exponent();
    if (in.filtered && in.filtered->filter == BumpFilter::toksvig)
        return toksvig_highlight(cosine, in.filtered->length, exponent);
    if (in.filtered && in.filtered->filter == BumpFilter::lean)
        return lean_highlight(box_around(in.half), *in.filtered, exponent);
    Interval power = cosine;
    for (int k = 0; k < in.highlight.squarings; ++k) power = squared(power);
    return power;
}

} // namespace shadowproof
