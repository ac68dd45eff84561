// Interval arithmetic. Bounds are computed in double; its own roundings are ignored, as they are a
// 2^29th of those of the floats that the intervals bound.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>

namespace shadowproof {

struct Interval {
    double low = 0;
    double high = 0;

    bool contains(double value) const { return low <= value && value <= high; }
    double middle() const { return 0.5 * (low + high); }
};
inline constexpr Interval any_number{-std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::infinity()};
using Intervals = std::array<Interval, 3>; ///< a colour's or a vector's components

/// Texture coordinates along and down the rows.
using PlaceRange = std::array<Interval, 2>;

inline Interval around(double middle, double radius = 0) {
    return {middle - radius, middle + radius};
}
inline Interval widened(const Interval& a, double by) {
    return {a.low - by, a.high + by};
}
inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
/// One interval for each component of a value.
template <class Value>
using RangeOf = std::array<Interval, static_cast<std::size_t>(Value::length())>;

template <class Value>
RangeOf<Value> range_of(const Value& value) {
    RangeOf<Value> range;
    for (int k = 0; k < Value::length(); ++k) range[static_cast<std::size_t>(k)] = around(value[k]);
    return range;
}

template <std::size_t n>
std::array<Interval, n> hull(std::array<Interval, n> a, const std::array<Interval, n>& b) {
    for (std::size_t k = 0; k < n; ++k) a[k] = hull(a[k], b[k]);
    return a;
}

inline Interval operator+(const Interval& a, const Interval& b) {
    return {a.low + b.low, a.high + b.high};
}
inline Interval operator*(const Interval& a, const Interval& b) {
    const std::array ends{a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
    return {*low, *high};
}
inline Interval operator*(double a, const Interval& b) {
    return around(a) * b;
}
inline Interval clamped(const Interval& a, double low, double high) {
    return {std::clamp(a.low, low, high), std::clamp(a.high, low, high)};
}
inline Interval not_negative(const Interval& a) {
    return {std::max(a.low, 0.0), std::max(a.high, 0.0)};
}
/// The largest number's size.
inline double size_of(const Interval& a) {
    return std::max(std::abs(a.low), std::abs(a.high));
}
inline Interval square_of(const Interval& a) {
    const double least = std::max({a.low, -a.high, 0.0});
    return {least * least, size_of(a) * size_of(a)};
}
/// For intervals that are not negative.
inline Interval squared(const Interval& a) {
    return {a.low * a.low, a.high * a.high};
}

inline Intervals around(const glm::dvec3& middle, double radius = 0) {
    return {around(middle.x, radius), around(middle.y, radius), around(middle.z, radius)};
}
inline Intervals hull(const Intervals& a, const Intervals& b) {
    return {hull(a[0], b[0]), hull(a[1], b[1]), hull(a[2], b[2])};
}
inline Interval dot(const Intervals& a, const Intervals& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline glm::dvec3 middle(const Intervals& a) {
    return {a[0].middle(), a[1].middle(), a[2].middle()};
}

} // namespace shadowproof
