// Exact arithmetic: integers of few digits on the stack, times powers of two, which suffice for
// nearly all inputs; and integers of any length (GMP) for inputs that are too large or too small
// for those. Seen by predicates.cpp alone.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace shadowproof {

/// An integer times a power of 2^64, exactly: few digits, kept in place, so that no memory is
/// allocated, and aligned to each other, so that nothing is shifted by bits.
class Limbs {
public:
    /// See limbs_smallest: what the predicates need.
    static constexpr std::size_t capacity = 24;

    Limbs() = default;
    /// `a` must be zero or normal.
    explicit Limbs(double a);
    Limbs(const Limbs& other) { *this = other; }
    Limbs& operator=(const Limbs& other) {
        sign_ = other.sign_;
        exponent_ = other.exponent_;
        count_ = other.count_;
        std::copy_n(other.limbs_.begin(), count_, limbs_.begin());
        return *this;
    }
    ~Limbs() = default;

    int sign() const { return sign_; }

    friend Limbs operator+(const Limbs& a, const Limbs& b) { return sum(a, b, b.sign_); }
    friend Limbs operator-(const Limbs& a, const Limbs& b) { return sum(a, b, -b.sign_); }
    friend Limbs operator*(const Limbs& a, const Limbs& b);

private:
    /// The digits of the absolute value, to base 2^64, lowest first; `count_` of them are set, the
    /// highest of which is not 0.
    std::array<mp_limb_t, capacity> limbs_;
    std::size_t count_ = 0;
    long exponent_ = 0; ///< of 2^64, for the lowest digit
    int sign_ = 0;

    static Limbs sum(const Limbs& a, const Limbs& b, int sign_of_b);
    static Limbs sum_from(const Limbs& low, int sign_of_low, const Limbs& high, int sign_of_high);
    void drop_leading_zeros();
};

/// Non-zero inputs within these magnitudes fit in the predicates, which are of degree 6 in
/// differences of inputs: 1e20 < 2^67, and 3 times 6 such factors, each a difference, are below
/// 2^415, digit 6 at most. The last bit of 1e-20 is at least 2^-119, in digit -2.
inline constexpr double limbs_smallest = 1e-20;
inline constexpr double limbs_largest = 1e20;

/// A ray's direction is one of those factors: the last bit of 1e-90 is at least 2^-351, in digit
/// -6. With five others the lowest digit is -16, and -16 to 6 are 23 digits; one more is for a
/// carry.
inline constexpr double limbs_smallest_direction = 1e-90;

/// Limbs, exact as long as no input was out of range; where one was, it counts as 0, and the result
/// is meaningless.
struct LimbsArithmetic {
    using Number = Limbs;
    bool* left_range; ///< set where an input is out of range

    Limbs number(double a) const { return checked(a, limbs_smallest); }
    Limbs direction(double a) const { return checked(a, limbs_smallest_direction); }
    Limbs difference(double a, double b) const {
        const double rounded = a - b;
        // Most are doubles: both roundings of Knuth's TWO-SUM are then nothing.
        const double part = rounded - a;
        if ((a - (rounded - part)) - (b + part) == 0 && fits(a) && fits(b)) return Limbs(rounded);
        return number(a) - number(b);
    }

private:
    static bool fits(double a, double smallest = limbs_smallest) {
        const double size = std::abs(a);
        return size == 0 || (size >= smallest && size <= limbs_largest);
    }
    Limbs checked(double a, double smallest) const {
        if (fits(a, smallest)) return Limbs(a);
        *left_range = true;
        return {};
    }
};

/// mantissa * 2^exponent: any finite double is one, and so are sums and products of any degree.
/// It needs no greatest common divisors, as a rational would.
struct Dyadic {
    mpz_class mantissa;
    long exponent = 0;

    int sign() const { return sgn(mantissa); }
    friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
        return {a.mantissa * b.mantissa, a.exponent + b.exponent};
    }
};

/// `a` must be finite.
Dyadic dyadic(double a);

struct DyadicArithmetic {
    using Number = Dyadic;
    Dyadic number(double a) const { return dyadic(a); }
    Dyadic direction(double a) const { return dyadic(a); }
    Dyadic difference(double a, double b) const { return dyadic(a) - dyadic(b); }
};

} // namespace shadowproof
