// How closely pixels are examined.
#pragma once

#include <cstdint>

namespace shadowproof {

/// What a pixel is compared with: all that the rasterizer may draw there, or its centre alone.
enum class Scrutiny : std::uint8_t { band, centre };

/// Once so many pixels are unexplained, the verdict is certain, and searching the bands of all
/// others would take minutes.
inline Scrutiny scrutiny_after(std::uint64_t unexplained) {
    constexpr std::uint64_t hopeless = 2048;
    return unexplained < hopeless ? Scrutiny::band : Scrutiny::centre;
}

} // namespace shadowproof
