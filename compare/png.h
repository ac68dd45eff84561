// PNG files of few values: gray, or with a palette of colours, which OpenImageIO does not write. A
// third of the bytes to compress, and so of the time that a report's pictures take.
#pragma once

#include "scenes/frame.h"
#include "scenes/image.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

using Rgb = std::array<std::uint8_t, 3>; ///< sRGB

struct PalettePicture {
    Image<std::uint8_t> indices; ///< into palette
    std::vector<Rgb> palette;    ///< at most 256

    const Rgb& at(int x, int y) const { return palette[indices.at(x, y)]; }
};

/// 8-bit gray. The same bytes for the same picture. Throws Error naming the file, or `named`: what
/// its reader knows of, where `file` stands beside its place.
void write_png(const std::filesystem::path& file, const Image<Visibility>& classes,
               const std::filesystem::path& named = {});
/// The same, 8 bits a colour.
void write_png(const std::filesystem::path& file, const Image<Rgb>& picture,
               const std::filesystem::path& named = {});
/// The same, with a palette of colours.
void write_png(const std::filesystem::path& file, const PalettePicture& picture);

/// What is wrong with a PNG file that should be of this size, none where nothing is. Every pixel is
/// decoded: a picture cut short still has its size in its header.
std::optional<std::string> png_damage(const std::filesystem::path& file, std::uint64_t width,
                                      std::uint64_t height);

} // namespace shadowproof
