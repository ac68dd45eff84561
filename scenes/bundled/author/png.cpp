#include "scenes/bundled/author/png.h"

#include <algorithm>
#include <string_view>

namespace shadowproof::author {

namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::uint32_t value, unsigned size) { // big end first
    for (unsigned i = size; i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/// CRC-32 as in PNG's annex D, bit by bit.
std::uint32_t crc_of(const Bytes& bytes) {
    std::uint32_t crc = 0xffffffffU;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    }
    return ~crc;
}

/// RFC 1950, section 8.2.
std::uint32_t adler_of(const Bytes& bytes) {
    std::uint32_t low = 1;
    std::uint32_t high = 0;
    for (const std::uint8_t byte : bytes) {
        low = (low + byte) % 65521;
        high = (high + low) % 65521;
    }
    return high << 16U | low;
}

void put_chunk(Bytes& png, std::string_view type, const Bytes& content) {
    put(png, static_cast<std::uint32_t>(content.size()), 4);
    Bytes checked(type.begin(), type.end());
    checked.insert(checked.end(), content.begin(), content.end());
    png.insert(png.end(), checked.begin(), checked.end());
    put(png, crc_of(checked), 4);
}

Bytes rows_of(const Raster& raster) {
    Bytes rows;
    const std::size_t row = std::size_t{raster.width} * raster.channels;
    for (std::size_t i = 0; i < raster.values.size(); ++i) {
        if (i % row == 0) rows.push_back(0); // the filter
        put(rows, raster.values[i], raster.bits / 8);
    }
    return rows;
}

Bytes stored(const Bytes& bytes) {
    constexpr std::size_t most = 65535; // a block
    Bytes zlib{0x78, 0x01};
    for (std::size_t first = 0; first < bytes.size(); first += most) {
        const std::size_t size = std::min(most, bytes.size() - first);
        zlib.push_back(first + size == bytes.size() ? 1 : 0);
        for (const std::size_t length : {size, ~size}) // little end first
            for (unsigned i = 0; i < 2; ++i)
                zlib.push_back(static_cast<std::uint8_t>(length >> (8 * i)));
        const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
        zlib.insert(zlib.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
    }
    put(zlib, adler_of(bytes), 4);
    return zlib;
}

} // namespace

Bytes png_of(const Raster& raster) {
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    Bytes header;
    put(header, raster.width, 4);
    put(header, raster.height, 4);
    const std::uint8_t color_type = raster.channels == 1 ? 0 : (raster.channels == 3 ? 2 : 6);
    for (const unsigned value : {raster.bits, unsigned{color_type}, 0U, 0U, 0U})
        header.push_back(static_cast<std::uint8_t>(value));
    put_chunk(png, "IHDR", header);
    put_chunk(png, "IDAT", stored(rows_of(raster)));
    put_chunk(png, "IEND", {});
    return png;
}

} // namespace shadowproof::author
