// Picture files: PNG by libpng, JPEG, Radiance and OpenEXR through OpenImageIO (PCX: pcx.h). Their
// sizes are known and checked before anything is decoded.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// Channel values as stored: integers of 8 and 16 bits divided by their largest, not multiplied by
/// alpha.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 0;          ///< 1 gray, 2 gray and alpha, 3 RGB, 4 RGBA; more: others follow
    int bits = 8;              ///< per channel: 8, 16, or 32 (anything but such integers)
    std::vector<float> values; ///< width * height * channels, rows from the top, all finite
};

/// Limits on the memory and time that a picture may take.
struct PictureRoom {
    const MemoryAccount& memory;
    std::uint64_t most_pixels = 0;
    /// Bytes that the caller makes of each pixel while the picture is still there.
    std::uint64_t bytes_made_of_pixel = 0;
};

/// Decodes a PNG or JPEG file's bytes, which are in the account already. Throws Error naming
/// `where`: another format, damaged, more than `most_pixels`, or more than the account has left.
/// The last two are checked before anything is decoded.
Picture decode_picture(std::span<const unsigned char> bytes, const std::string& where,
                       const PictureRoom& room);

/// Reads a PNG, JPEG, Radiance (.hdr) or OpenEXR file (flat, of one part). Other formats are
/// refused, because the memory that their decoders take cannot be predicted from the file. Throws
/// Error naming the file.
Picture read_picture(const std::filesystem::path& file, const PictureRoom& room);

} // namespace shadowproof
