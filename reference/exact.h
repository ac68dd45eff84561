// Exact arithmetic: floating-point expansions (Shewchuk 1997, Adaptive Precision Floating-Point
// Arithmetic), and GMP rationals for inputs so large or small that expansions would over- or
// underflow. Seen by predicates.cpp alone.
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

/// Expansions whose storage is released together with the arena.
struct ExpansionArithmetic {
    using Number = Expansion;
    std::pmr::memory_resource* arena;
    Expansion number(double a) const { return {a, arena}; }
    Expansion difference(double a, double b) const { return exact_difference(a, b, arena); }
};

/// Non-zero inputs within these magnitudes neither over- nor underflow in the predicates: those are
/// of degree 6 in differences of inputs. A difference of two doubles of at least 1e-20 is zero or
/// at least 2^-53 * 1e-20 > 1e-36; six of them and the last error term: 1e-216 * 2^-53 > 1e-233,
/// far from the smallest double; 1e20^6 is as far from the largest.
inline constexpr double expansion_smallest = 1e-20;
inline constexpr double expansion_largest = 1e20;

/// A ray's direction enters once, beside five differences: 1e-180 so far. Its component is a sum of
/// the camera's axes times factors that are zero or above 1e-16 * 1e-20 (a rounded picture place
/// times tan_half_height); cancellation leaves 2^-53 of the smallest term. With axes of at least
/// 1e-40 that is above 1e-92, and 1e-180 * 1e-92 * 2^-53 > 1e-288 still holds.
inline constexpr double expansion_smallest_axis = 1e-40;

struct RationalArithmetic {
    struct Number {
        mpq_class value;
        int sign() const { return sgn(value); }
        friend Number operator+(const Number& a, const Number& b) { return {a.value + b.value}; }
        friend Number operator-(const Number& a, const Number& b) { return {a.value - b.value}; }
        friend Number operator*(const Number& a, const Number& b) { return {a.value * b.value}; }
    };
    Number number(double a) const { return {mpq_class(a)}; }
    Number difference(double a, double b) const { return {mpq_class(a) - mpq_class(b)}; }
};

} // namespace shadowproof
