// Double arithmetic that carries a bound of its own rounding error, so that a sign is either
// certain or known to be uncertain.
#pragma once

#include "scenes/roundoff.h"

#include <cmath>
#include <limits>
#include <optional>

namespace shadowproof {

/// The true value lies within value +- error.
///
/// Each operation adds the propagated errors, its own rounding u |result| with u = 2^-53, and
/// DBL_MIN for underflow; the bound itself is rounded too, in at most six operations, which the
/// factor 1 + 8u covers. Running error analysis: Higham, Accuracy and Stability of Numerical
/// Algorithms, section 3.3. NaN and infinity leave the sign uncertain.
struct Bounded {
    double value = 0;
    double error = 0;

    static constexpr double u = double_roundoff;
    static constexpr double slack = 1 + 8 * u;
    static constexpr double underflow = std::numeric_limits<double>::min();

    /// -1, 0 or 1 where certain.
    std::optional<int> sign() const {
        if (value > error) return 1;
        if (value < -error) return -1;
        if (value == 0 && error == 0) return 0;
        return std::nullopt;
    }
};

inline Bounded operator+(const Bounded& a, const Bounded& b) {
    const double value = a.value + b.value;
    return {value, (a.error + b.error + Bounded::u * std::abs(value)) * Bounded::slack};
}

inline Bounded operator-(const Bounded& a, const Bounded& b) {
    return a + Bounded{-b.value, b.error};
}

inline Bounded operator*(const Bounded& a, const Bounded& b) {
    // A factor that is exactly zero has an exactly zero product: signs that are zero by structure
    // (an axis-parallel ray, say) need no exact arithmetic.
    if ((a.value == 0 && a.error == 0) || (b.value == 0 && b.error == 0)) return {0, 0};
    const double value = a.value * b.value;
    return {value, (std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error +
                    Bounded::u * std::abs(value) + Bounded::underflow) *
                       Bounded::slack};
}

/// Sums and differences of the inputs themselves.
struct BoundedArithmetic {
    using Number = Bounded;
    Bounded number(double a) const { return {a, 0}; }
    Bounded direction(double a) const { return {a, 0}; }
    Bounded difference(double a, double b) const {
        const double value = a - b;
        return {value, Bounded::u * std::abs(value)};
    }
};

} // namespace shadowproof
