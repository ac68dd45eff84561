// What OpenImageIO does: reads JPEG and OpenEXR, and writes OpenEXR and PNG. It comes with 240
// libraries, whose loading takes a fifth of a second. So it is a library of its own, loaded once a
// picture needs it.
#pragma once

#include "scenes/load/picture/picture.h"
#include "scenes/load/picture/picture_head.h"
#include "scenes/load/picture/picture_layout.h"

#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// The functions of the library. Each says what is wrong, or nothing; only std::bad_alloc is
/// thrown.
struct OpenImageIo {
    /// Decodes a picture whose file would be called `name`, as "memory.jpg", into `picture`, which
    /// may hold values that are not finite. Wrong unless it has the size that its head tells of.
    std::string (*decode)(const char* name, std::span<const unsigned char> bytes,
                          const PictureHead& head, Picture& picture);
    /// Encodes all pixels, which lie as `layout` says, without gaps.
    std::string (*encode)(const PictureLayout& layout, const void* pixels,
                          std::vector<unsigned char>& bytes);
};

/// The library's, loaded at the first call. Throws Error where it is not found.
const OpenImageIo& openimageio();

/// The name under which the library exports a function that returns them. Its number changes with
/// what passes between both.
inline constexpr const char* openimageio_entry = "shadowproof_openimageio_1";

} // namespace shadowproof
