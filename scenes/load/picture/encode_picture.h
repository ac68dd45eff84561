// Pictures as the bytes of a file.
#pragma once

#include "scenes/load/picture/picture_layout.h"

#include <string>

namespace shadowproof {

/// `pixels`: all, without gaps, as `layout` says. The same pixels always give the same bytes.
/// Throws Error naming `file`, to which they will be written.
std::string encode_picture(const PictureLayout& layout, const void* pixels,
                           const std::string& file);

} // namespace shadowproof
