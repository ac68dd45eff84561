#include "scenes/load/picture/pcx.h"

#include "scenes/error.h"
#include "scenes/load/common/module.h"
#include "scenes/load/picture/picture_head.h"
#include "scenes/load/picture/png_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#ifndef SHADOWPROOF_BUILT_PCX
#error "SHADOWPROOF_BUILT_PCX and SHADOWPROOF_INSTALLED_PCX: by CMakeLists.txt"
#endif

namespace shadowproof {

namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::size_t head_bytes = 128; // ZSoft, PCX File Format Technical Reference Manual

const PcxLibrary& library() {
    using Entry = const PcxLibrary* (*)();
    static const PcxLibrary& loaded = *reinterpret_cast<Entry>(module_symbol(
        "PCX pictures", {SHADOWPROOF_INSTALLED_PCX, SHADOWPROOF_BUILT_PCX}, pcx_entry))();
    return loaded;
}

int word(Bytes bytes, std::size_t at) {
    return bytes[at] | bytes[at + 1] << 8;
}

/// Whether run lengths fill all rows: libavcodec takes what is missing from where it lies. In front
/// of a palette, which stands behind a byte at the end.
bool are_whole(Bytes bytes, int height) {
    constexpr std::size_t palette_bytes = 769;
    constexpr unsigned char run = 0xC0; // the two highest bits; the others are its length
    const std::size_t planes = bytes[65];
    const std::size_t row = planes * static_cast<std::size_t>(word(bytes, 66));
    const bool has_palette = bytes[3] == 8 && planes == 1;
    if (has_palette && bytes.size() < head_bytes + palette_bytes) return false;
    const std::size_t end = bytes.size() - (has_palette ? palette_bytes : 0);
    std::size_t at = head_bytes;
    for (int y = 0; y < height; ++y)
        for (std::size_t filled = 0; filled < row;) {
            if (at == end) return false;
            const unsigned char value = bytes[at++];
            if (value >= run && at++ == end) return false;
            filled += value >= run ? value - run : 1;
        }
    return true;
}

} // namespace

bool is_pcx(Bytes bytes) {
    constexpr unsigned char manufacturer = 10;
    constexpr unsigned char last_version = 5;
    constexpr unsigned char run_lengths = 1;
    return bytes.size() > head_bytes && bytes[0] == manufacturer && bytes[1] <= last_version &&
           bytes[2] == run_lengths;
}

Picture decode_pcx(Bytes bytes, const std::string& where, const PictureRoom& room) {
    if (!is_pcx(bytes)) throw Error(where, "is no PCX picture", picture_remedy);
    constexpr std::size_t most_bytes = std::size_t{1} << 30U; // libavcodec counts them by an int
    if (bytes.size() > most_bytes)
        throw Error(where, "is longer than a PCX picture can be", picture_remedy);
    const int width = word(bytes, 8) - word(bytes, 4) + 1;
    const int height = word(bytes, 10) - word(bytes, 6) + 1;
    if (width < 1 || height < 1)
        throw Error(where, fmt::format("is a PCX picture of {}x{} pixels", width, height),
                    picture_remedy);
    // The decoder's frame of up to 4 bytes a pixel, whose rows it pads, and a row of all planes;
    // RGB; the bytes once more.
    const auto columns = static_cast<std::uint64_t>(width);
    const auto rows = static_cast<std::uint64_t>(height);
    require_room(columns, rows, 3,
                 4 * (columns + pcx_padding) * (rows + pcx_padding) + 3 * columns * rows +
                     bytes.size(),
                 where, room);
    if (!are_whole(bytes, height))
        throw Error(where, "is damaged: it ends within its rows", picture_remedy);
    std::vector<std::uint8_t> rgb;
    if (const std::string wrong = library().decode(bytes, width, height, rgb); !wrong.empty())
        throw Error(where, wrong, picture_remedy);
    Picture picture{width, height, 3, 8, {}};
    picture.values.reserve(rgb.size());
    std::transform(rgb.begin(), rgb.end(), std::back_inserter(picture.values),
                   [](std::uint8_t value) { return static_cast<float>(value / 255.0); });
    return picture;
}

} // namespace shadowproof
