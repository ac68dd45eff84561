// The verdict on one pixel's colour.
#pragma once

#include <cstdint>

namespace shadowproof {

enum class ColorVerdict : std::uint8_t {
    as_shown,    ///< background, or a wrong surface or visibility: what the technique's arithmetic
                 ///< predicts for what it shows
    within,      ///< within the bound
    beyond,      ///< beyond the bound, but predicted by the technique's arithmetic
    unpredicted, ///< not predicted by that arithmetic, though within the bound
    unexplained, ///< beyond the bound, or of what has none, and not predicted
    moved, ///< beyond 1/255 of the truth, which a technique that uses floats alone may not be; but
           ///< predicted, and right for a place that the rasterizer may have drawn instead
};

} // namespace shadowproof
