// How the pixels of a picture lie in memory, for writing them to a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

struct PictureLayout {
    enum class Format : std::uint8_t { openexr, png };
    enum class Type : std::uint8_t { u8, u16, u32, f32 };
    struct Channel {
        std::string name; ///< in OpenEXR, as "depth.Z"
        Type type = Type::f32;
    };

    Format format = Format::openexr;
    int width = 0;
    int height = 0;
    std::vector<Channel> channels; ///< in a PNG all of one type: R, G, B and A
};

} // namespace shadowproof
