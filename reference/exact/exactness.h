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

/// Whether doubles with bounds of their errors are asked first. Without them all signs are exact
/// arithmetic's, which are the same: for tests, and to measure what filters save.
enum class Filters : std::uint8_t { on, off };

} // namespace shadowproof
