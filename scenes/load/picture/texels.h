// A picture's pixels as the texels that lighting samples.
#pragma once

#include "scenes/load/picture/picture.h"
#include "scenes/texture.h"

#include <cstdint>

namespace shadowproof {

/// How the colour channels of a picture are encoded (alpha is always a plain number).
enum class Encoding : std::uint8_t {
    srgb,  ///< colours, IEC 61966-2-1
    plain, ///< numbers: normals, heights
};

/// Alpha alone; 1 where it is missing.
Image<float> alpha_of(const Picture& picture);

/// The pixels as vectors: gray fills all three colours, a missing alpha is 1.
Image<glm::vec4> texels_of(const Picture& picture, Encoding encoding);

} // namespace shadowproof
