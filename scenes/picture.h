// Pictures as files hold them, through OpenImageIO.
#pragma once

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

/// A PNG or JPEG file's bytes. Throws Error naming `where`: neither of them, damaged, or more than
/// `most_pixels` of them, which is known before any is decoded.
Picture decode_picture(std::span<const unsigned char> bytes, const std::string& where,
                       std::uint64_t most_pixels);

/// A file of any format that OpenImageIO knows. Throws Error naming the file.
Picture read_picture(const std::filesystem::path& file, std::uint64_t most_pixels);

} // namespace shadowproof
