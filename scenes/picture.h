// Pictures as files hold them: PNG by libpng, JPEG and OpenEXR through OpenImageIO. Sizes are known
// and asked for before anything is decoded.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// Channel values as stored: integers of 8 and 16 bits over their largest, alpha not multiplied in.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 0;          ///< 1 gray, 2 gray and alpha, 3 RGB, 4 RGBA, more: others behind
    int bits = 8;              ///< a channel has: 8, 16, or 32 (whatever is no such integer)
    std::vector<float> values; ///< width * height * channels, rows from the top, all finite
};

/// What a picture may take.
struct PictureRoom {
    const MemoryAccount& memory;
    std::uint64_t most_pixels = 0;
    /// Bytes that the caller makes of each pixel while the picture is still there.
    std::uint64_t bytes_made_of_pixel = 0;
};

/// A PNG or JPEG file's bytes, which are in the account already. Throws Error naming `where`:
/// neither of them, damaged, more than `most_pixels`, or more than the account has left, both of
/// which is known before any is decoded.
Picture decode_picture(std::span<const unsigned char> bytes, const std::string& where,
                       const PictureRoom& room);

/// A PNG, JPEG or OpenEXR file (flat, of one part). Others are not read, for what their decoders
/// take cannot be told from the file before they take it. Throws Error naming the file.
Picture read_picture(const std::filesystem::path& file, const PictureRoom& room);

} // namespace shadowproof
