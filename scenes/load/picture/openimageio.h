// The functions of OpenImageIO: reading JPEG and OpenEXR, writing OpenEXR and PNG. It depends on
// 240 libraries, which take a fifth of a second to load; so it is in a module that is loaded only
// when a picture needs it.
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
    /// may hold values that are not finite. It is an error if the picture does not have the size
    /// that its header says.
    std::string (*decode)(const char* name, std::span<const unsigned char> bytes,
                          const PictureHead& head, Picture& picture);
    /// Encodes all pixels, which lie as `layout` says, without gaps.
    std::string (*encode)(const PictureLayout& layout, const void* pixels,
                          std::vector<unsigned char>& bytes);
};

/// The library's functions. It is loaded at the first call. Throws Error where it is not found.
const OpenImageIo& openimageio();

/// The name under which the library exports a function that returns an OpenImageIo. Its number
/// changes whenever this interface does.
inline constexpr const char* openimageio_entry = "shadowproof_openimageio_1";

} // namespace shadowproof
