#include "compare/perceptible.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

namespace shadowproof {

namespace {

OIIO::ImageBuf wrapped(const Image<glm::vec3>& picture) {
    OIIO::ImageBuf buffer(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT));
    buffer.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, picture.pixels.data());
    return buffer;
}

} // namespace

std::uint64_t count_perceptible(const Image<glm::vec3>& one, const Image<glm::vec3>& other) {
    if (one.pixels == other.pixels) return 0;
    OIIO::ImageBufAlgo::CompareResults result;
    OIIO::ImageBufAlgo::compare_Yee(wrapped(one), wrapped(other), result);
    return static_cast<std::uint64_t>(result.nfail);
}

} // namespace shadowproof
