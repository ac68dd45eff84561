// PNG files by libpng itself. OpenImageIO leaves libpng its own handler of errors, which prints
// them, and reads every chunk of words and profiles, which may be compressed a thousandfold.
#pragma once

#include "scenes/picture.h"

namespace shadowproof {

/// Throws Error naming `where`. Chunks that say nothing of the pixels' values are passed over.
Picture decode_png(std::span<const unsigned char> bytes, const std::string& where,
                   const PictureRoom& room);

/// Throws Error where a picture of that size is more than the room for it. `stored` bytes are
/// taken by its decoder beside the values.
void require_room(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                  std::uint64_t stored, const std::string& where, const PictureRoom& room);

} // namespace shadowproof
