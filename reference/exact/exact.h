// Exact arithmetic: floating-point expansions (Shewchuk 1997, Adaptive Precision Floating-Point
// Arithmetic), and integers times powers of two (GMP) for inputs so large or small that expansions
// would over- or underflow. Seen by predicates.cpp alone.
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <vector>

namespace shadowproof {

/// A sum of doubles, exactly: strongly nonoverlapping, by increasing magnitude, without zeros.
/// Round-to-nearest-even is required (no other mode is ever set in this program).
class Expansion {
public:
    explicit Expansion(std::pmr::memory_resource* arena) : terms_(arena) {}
    Expansion(double term, std::pmr::memory_resource* arena) : terms_(arena) { push(term); }

    int sign() const { return terms_.empty() ? 0 : (terms_.back() > 0 ? 1 : -1); }

    friend Expansion operator+(const Expansion& a, const Expansion& b) { return a.sum(b, 1); }
    friend Expansion operator-(const Expansion& a, const Expansion& b) { return a.sum(b, -1); }
    friend Expansion operator*(const Expansion& a, const Expansion& b);
    friend Expansion exact_difference(double a, double b, std::pmr::memory_resource* arena);

private:
    std::pmr::vector<double> terms_;

    std::pmr::memory_resource* arena() const { return terms_.get_allocator().resource(); }
    void push(double term) {
        if (term != 0) terms_.push_back(term);
    }
    Expansion sum(const Expansion& other, double factor) const; ///< factor +1 or -1
    Expansion scaled(double factor) const;
};

Expansion exact_difference(double a, double b, std::pmr::memory_resource* arena);

/// Non-zero inputs within these magnitudes neither over- nor underflow in the predicates: those are
/// of degree 6 in differences of inputs. A difference of two doubles of at least 1e-20 is zero or
/// at least 2^-53 * 1e-20 > 1e-36; six of them and the last error term: 1e-216 * 2^-53 > 1e-233,
/// far from the smallest double; 1e20^6 is as far from the largest.
inline constexpr double expansion_smallest = 1e-20;
inline constexpr double expansion_largest = 1e20;

/// A ray's direction is one factor, with five differences: 1e-180 so far, and 1e-180 * 1e-90 *
/// 2^-53 > 1e-287 is still a normal double.
inline constexpr double expansion_smallest_direction = 1e-90;

/// Expansions whose storage is released together with the arena. They are exact as long as no input
/// was out of range; where one was, the result is meaningless.
struct ExpansionArithmetic {
    using Number = Expansion;
    std::pmr::memory_resource* arena;
    bool* left_range; ///< set where an input is out of range

    Expansion number(double a) const {
        note(a, expansion_smallest);
        return {a, arena};
    }
    Expansion direction(double a) const {
        note(a, expansion_smallest_direction);
        return {a, arena};
    }
    Expansion difference(double a, double b) const {
        note(a, expansion_smallest);
        note(b, expansion_smallest);
        return exact_difference(a, b, arena);
    }

private:
    void note(double a, double smallest) const {
        const double size = std::abs(a);
        if (size != 0 && !(size >= smallest && size <= expansion_largest)) *left_range = true;
    }
};

/// mantissa * 2^exponent: any finite double is one, and so are sums and products of any degree.
/// Costs a few times what an expansion does, and no greatest common divisors as a rational would.
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
