// How highlights are made: which vector's self-shadowing dims them, and their exponent.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace shadowproof {

/// selfShadow(v) = clamp(8 v . N, 0, 1) of which vector dims the highlight. Kilgard's rule (2001,
/// The Required Per-Pixel Math) has the light's; the passes that he shows have others.
enum class HighlightShadow : std::uint8_t { light, half_angle, both, none };
inline constexpr std::array all_highlight_shadows{HighlightShadow::light,
                                                  HighlightShadow::half_angle,
                                                  HighlightShadow::both, HighlightShadow::none};

constexpr std::string_view name_of(HighlightShadow shadow) {
    switch (shadow) {
    case HighlightShadow::light:
        return "light";
    case HighlightShadow::half_angle:
        return "half_angle";
    case HighlightShadow::both:
        return "both";
    case HighlightShadow::none:
        break;
    }
    return "none";
}

constexpr bool by_light(HighlightShadow shadow) {
    return shadow == HighlightShadow::light || shadow == HighlightShadow::both;
}
constexpr bool by_half_angle(HighlightShadow shadow) {
    return shadow == HighlightShadow::half_angle || shadow == HighlightShadow::both;
}

/// Exponents are powers of two, made by squaring, as register combiners make the eighth.
inline constexpr int largest_squarings = 7;

struct Highlight {
    HighlightShadow shadow = HighlightShadow::light;
    int squarings = 3;
    int exponent() const { return 1 << squarings; }
    friend bool operator==(const Highlight&, const Highlight&) = default;
};

} // namespace shadowproof
