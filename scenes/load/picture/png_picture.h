// PNG files by libpng itself. OpenImageIO leaves in place libpng's own error handler, which prints,
// and reads every chunk of text and profiles, which may be compressed a thousandfold.
#pragma once

#include "scenes/load/picture/picture.h"

namespace shadowproof {

/// Throws Error naming `where`. Chunks that do not affect the pixels' values are skipped.
Picture decode_png(std::span<const unsigned char> bytes, const std::string& where,
                   const PictureRoom& room);

/// Throws Error where a picture of that size exceeds the room for it. `stored`: bytes that its
/// decoder takes besides the values.
void require_room(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                  std::uint64_t stored, const std::string& where, const PictureRoom& room);

} // namespace shadowproof
