// The range of a figure that a correct rasterizer may produce.
#pragma once

#include <cstdint>

namespace shadowproof {

struct FigureRange {
    std::uint64_t low = 0;
    std::uint64_t high = 0; ///< at least low

    bool holds(std::uint64_t figure) const { return figure >= low && figure <= high; }
};

} // namespace shadowproof
