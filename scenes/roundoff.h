// How far rounding to the nearest number moves a value, as a share of it: what every bound of a
// rounding error is made of.
#pragma once

namespace shadowproof {

inline constexpr double float_roundoff = 0x1p-24;  ///< of a float, at most
inline constexpr double double_roundoff = 0x1p-53; ///< of a double, at most

} // namespace shadowproof
