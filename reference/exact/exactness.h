// How much precision the decision of a sign took.
#pragma once

#include <cstdint>

namespace shadowproof {

/// How a pixel was decided. Ordered; a pixel records the highest of its signs.
enum class Exactness : std::uint8_t {
    filtered,   ///< float and double filters decided all
    exact,      ///< at least one sign came from exact arithmetic
    degenerate, ///< at least one sign was exactly zero
};

} // namespace shadowproof
