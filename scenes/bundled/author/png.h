// PNG files whose bytes depend on nothing but their pixels: stored, not compressed, because
// compressors change from version to version.
#pragma once

#include <cstdint>
#include <vector>

namespace shadowproof::author {

/// Rows from the top, channels side by side.
struct Raster {
    unsigned width = 0;
    unsigned height = 0;
    unsigned channels = 3; ///< 1 gray, 3 RGB, 4 RGBA
    unsigned bits = 8;     ///< per channel: 8 or 16
    std::vector<std::uint16_t> values;
};

/// PNG (ISO/IEC 15948), each row with filter 0, in deflate blocks without compression (RFC 1951,
/// section 3.2.4).
std::vector<std::uint8_t> png_of(const Raster& raster);

} // namespace shadowproof::author
