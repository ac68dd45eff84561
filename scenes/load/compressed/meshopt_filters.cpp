#include "scenes/load/compressed/meshopt_parts.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace shadowproof::meshopt {

namespace {

/// Applies `change` to every run of N components of type T.
template <class T, std::size_t N, class Change>
void for_each(std::span<unsigned char> target, const Change& change) {
    std::array<T, N> components{};
    for (std::size_t at = 0; at + sizeof components <= target.size(); at += sizeof components) {
        std::memcpy(components.data(), target.data() + at, sizeof components);
        change(components);
        std::memcpy(target.data() + at, components.data(), sizeof components);
    }
}

/// Rounded to the nearest, halves away from zero; clamped; 0 for what is no number.
template <class T>
T rounded(double value) {
    if (!std::isfinite(value)) return 0;
    const double lowest = std::numeric_limits<T>::min();
    const double highest = std::numeric_limits<T>::max();
    return static_cast<T>(std::clamp(std::round(value), lowest, highest));
}

/// x and y of a unit vector on an octahedron, whose size is the third component.
template <class T>
void undo_octahedral(std::span<unsigned char> target) {
    for_each<T, 4>(target, [](std::array<T, 4>& v) {
        const double one = v[2];
        double x = v[0] / one;
        double y = v[1] / one;
        const double z = 1 - std::abs(x) - std::abs(y);
        const double folded = std::max(-z, 0.0);
        x -= std::copysign(folded, x);
        y -= std::copysign(folded, y);
        const double scale = std::numeric_limits<T>::max() / std::sqrt(x * x + y * y + z * z);
        v[0] = rounded<T>(x * scale);
        v[1] = rounded<T>(y * scale);
        v[2] = rounded<T>(z * scale);
    });
}

/// Three components of a unit quaternion; the largest follows from them. The last two bits of the
/// fourth number say which one that is.
void undo_quaternion(std::span<unsigned char> target) {
    for_each<std::int16_t, 4>(target, [](std::array<std::int16_t, 4>& v) {
        const auto largest = static_cast<std::size_t>(v[3] & 3);
        const double scale = std::sqrt(0.5) / (v[3] | 3);
        const double x = v[0] * scale;
        const double y = v[1] * scale;
        const double z = v[2] * scale;
        const double w = std::sqrt(std::max(0.0, 1 - x * x - y * y - z * z));
        v.at((largest + 1) % 4) = rounded<std::int16_t>(x * 32767);
        v.at((largest + 2) % 4) = rounded<std::int16_t>(y * 32767);
        v.at((largest + 3) % 4) = rounded<std::int16_t>(z * 32767);
        v.at(largest) = rounded<std::int16_t>(w * 32767);
    });
}

/// A signed exponent of 8 bits above a signed mantissa of 24: exact in float, but below 2^-126.
void undo_exponential(std::span<unsigned char> target) {
    for_each<std::uint32_t, 1>(target, [](std::array<std::uint32_t, 1>& v) {
        const auto bits = static_cast<std::int32_t>(v[0]);
        const std::int32_t mantissa = static_cast<std::int32_t>(v[0] << 8U) >> 8;
        v[0] = std::bit_cast<std::uint32_t>(std::ldexp(static_cast<float>(mantissa), bits >> 24));
    });
}

/// Luma and two signed chromas to red, green and blue. The highest bit of alpha tells how many bits
/// all of them have.
template <class Unsigned, class Signed>
void undo_color(std::span<unsigned char> target) {
    for_each<Unsigned, 4>(target, [](std::array<Unsigned, 4>& v) {
        const int luma = v[0];
        const int orange = static_cast<Signed>(v[1]);
        const int green = static_cast<Signed>(v[2]);
        const auto highest =
            static_cast<int>((1U << std::bit_width(static_cast<unsigned>(v[3]))) - 1);
        const int alpha = v[3] & highest >> 1;
        const double scale = static_cast<double>(std::numeric_limits<Unsigned>::max()) / highest;
        v[0] = rounded<Unsigned>((luma + orange - green) * scale);
        v[1] = rounded<Unsigned>((luma + green) * scale);
        v[2] = rounded<Unsigned>((luma - orange - green) * scale);
        v[3] = rounded<Unsigned>((alpha << 1 | (alpha & 1)) * scale);
    });
}

} // namespace

void undo_filter(const MeshoptLayout& layout, std::span<unsigned char> target) {
    const bool is_narrow = layout.stride == 4;
    switch (layout.filter) {
    case MeshoptFilter::none:
        return;
    case MeshoptFilter::octahedral:
        return is_narrow ? undo_octahedral<std::int8_t>(target)
                         : undo_octahedral<std::int16_t>(target);
    case MeshoptFilter::quaternion:
        return undo_quaternion(target);
    case MeshoptFilter::exponential:
        return undo_exponential(target);
    case MeshoptFilter::color:
        return is_narrow ? undo_color<std::uint8_t, std::int8_t>(target)
                         : undo_color<std::uint16_t, std::int16_t>(target);
    }
}

} // namespace shadowproof::meshopt
