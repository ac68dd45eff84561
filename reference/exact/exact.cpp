#include "reference/exact/exact.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace shadowproof {

namespace {

struct Pair {
    double high = 0; ///< the rounded result
    double low = 0;  ///< its rounding error: high + low is exact
};

/// Knuth's TWO-SUM: no assumption on magnitudes.
Pair two_sum(double a, double b) {
    const double high = a + b;
    const double b_part = high - a;
    const double a_part = high - b_part;
    return {high, (a - a_part) + (b - b_part)};
}

/// Dekker's FAST-TWO-SUM: |a| >= |b| or a is 0.
Pair fast_two_sum(double a, double b) {
    const double high = a + b;
    return {high, b - (high - a)};
}

Pair two_product(double a, double b) {
    const double high = a * b;
    return {high, std::fma(a, b, -high)};
}

} // namespace

Expansion exact_difference(double a, double b, std::pmr::memory_resource* arena) {
    const auto [high, low] = two_sum(a, -b);
    Expansion result(arena);
    result.push(low);
    result.push(high);
    return result;
}

/// FAST-EXPANSION-SUM with zero elimination: merge by magnitude, then one sweep of TWO-SUMs.
Expansion Expansion::sum(const Expansion& other, double factor) const {
    Expansion result(arena());
    const std::size_t n = terms_.size();
    const std::size_t m = other.terms_.size();
    if (n + m == 0) return result;
    result.terms_.reserve(n + m);
    std::size_t i = 0;
    std::size_t j = 0;
    const auto next = [&] {
        const bool mine = j == m || (i < n && std::abs(terms_[i]) <= std::abs(other.terms_[j]));
        return mine ? terms_[i++] : factor * other.terms_[j++];
    };
    double running = next();
    while (i < n || j < m) {
        const auto [high, low] = two_sum(running, next());
        result.push(low);
        running = high;
    }
    result.push(running);
    return result;
}

/// SCALE-EXPANSION with zero elimination.
Expansion Expansion::scaled(double factor) const {
    Expansion result(arena());
    if (terms_.empty() || factor == 0) return result;
    result.terms_.reserve(2 * terms_.size());
    auto [running, first_low] = two_product(terms_[0], factor);
    result.push(first_low);
    for (std::size_t i = 1; i < terms_.size(); ++i) {
        const auto [high, low] = two_product(terms_[i], factor);
        const Pair sum = two_sum(running, low);
        result.push(sum.low);
        const Pair carried = fast_two_sum(high, sum.high);
        result.push(carried.low);
        running = carried.high;
    }
    result.push(running);
    return result;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
    const Expansion& shorter = a.terms_.size() < b.terms_.size() ? a : b;
    const Expansion& longer = &shorter == &a ? b : a;
    Expansion result(a.arena());
    for (const double term : shorter.terms_) result = result + longer.scaled(term);
    return result;
}

Dyadic dyadic(double a) {
    assert(std::isfinite(a));
    int exponent = 0;
    // 53 bits: the product is an integer.
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(a, &exponent), 53));
    exponent -= 53;
    if (mantissa == 0) return {};
    const int zeros = __builtin_ctzll(static_cast<std::uint64_t>(mantissa));
    return {mpz_class(static_cast<long>(mantissa >> zeros)), exponent + zeros};
}

namespace {

/// The mantissa that `number` has at an exponent not above its own.
mpz_class mantissa_at(long exponent, const Dyadic& number) {
    return number.mantissa << static_cast<mp_bitcnt_t>(number.exponent - exponent);
}

/// a + factor b, factor 1 or -1. The exponent of a zero is ignored: it would only make the other's
/// mantissa longer.
Dyadic sum(const Dyadic& a, const Dyadic& b, int factor) {
    if (b.sign() == 0) return a;
    if (a.sign() == 0) return {b.mantissa * factor, b.exponent};
    const long exponent = std::min(a.exponent, b.exponent);
    return {mantissa_at(exponent, a) + factor * mantissa_at(exponent, b), exponent};
}

} // namespace

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    return sum(a, b, 1);
}
Dyadic operator-(const Dyadic& a, const Dyadic& b) {
    return sum(a, b, -1);
}

} // namespace shadowproof
