// PCX, the format of Quake II's skins: libavcodec decodes it, in a library of its own that is
// loaded once such a picture is there.
#pragma once

#include "scenes/load/picture/picture.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// By its first bytes.
bool is_pcx(std::span<const unsigned char> bytes);

/// Decodes a file's bytes, which are in the account already, to RGB of 8 bits. Throws Error naming
/// `where`: no PCX file, damaged, or more than there is room for, which is checked before anything
/// is decoded.
Picture decode_pcx(std::span<const unsigned char> bytes, const std::string& where,
                   const PictureRoom& room);

/// Pixels by which the decoder pads a row, or rows by which it pads a picture, at most.
inline constexpr int pcx_padding = 128;

/// What the library does.
struct PcxLibrary {
    /// Writes rows of RGB from the top, 3 * width * height bytes, to `rgb`. Says what is wrong, or
    /// nothing; only std::bad_alloc is thrown.
    std::string (*decode)(std::span<const unsigned char> bytes, int width, int height,
                          std::vector<std::uint8_t>& rgb);
};

/// The name under which the library exports a function that returns a PcxLibrary. Its number
/// changes whenever this interface does.
inline constexpr const char* pcx_entry = "shadowproof_pcx_1";

} // namespace shadowproof
