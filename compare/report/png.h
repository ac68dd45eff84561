// PNG files in gray, RGB, or with a palette, which OpenImageIO does not write. Gray and palettes
// have a third of the bytes to compress, and take a third of the time.
#pragma once

#include "compare/json/memo.h"
#include "scenes/frame.h"
#include "scenes/image.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

using Rgb = std::array<std::uint8_t, 3>; ///< sRGB

struct PalettePicture {
    Image<std::uint8_t> indices; ///< into palette
    std::vector<Rgb> palette;    ///< at most 256

    const Rgb& at(int x, int y) const { return palette[indices.at(x, y)]; }
};

/// The bytes of a PNG file, 8-bit gray. The same for the same picture. With a memo pixels that were
/// compressed before are not compressed again.
std::string to_png(const Image<Visibility>& classes, Memo* memo = nullptr);
/// The same, 8 bits a colour.
std::string to_png(const Image<Rgb>& picture);
/// The same, with a palette of colours.
std::string to_png(const PalettePicture& picture, Memo* memo = nullptr);

/// What is wrong with the bytes of a PNG file that should be of this size; none if it is intact.
/// Every pixel is decoded, as a truncated picture still has its size in its header.
std::optional<std::string> png_damage(std::string_view bytes, std::uint64_t width,
                                      std::uint64_t height);

} // namespace shadowproof
