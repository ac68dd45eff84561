#include "scenes/load/picture/encode_picture.h"

#include "scenes/error.h"
#include "scenes/load/picture/openimageio.h"

namespace shadowproof {

std::string encode_picture(const PictureLayout& layout, const void* pixels,
                           const std::string& file) {
    std::vector<unsigned char> bytes;
    const std::string wrong = openimageio().encode(layout, pixels, bytes);
    if (!wrong.empty()) throw Error(file, wrong, "try a smaller picture");
    return {bytes.begin(), bytes.end()};
}

} // namespace shadowproof
