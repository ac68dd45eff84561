// Shadows read from pictures: the evidence of a claim that another renderer made.
#pragma once

#include "scenes/image.h"

#include <cstdint>
#include <string>

namespace shadowproof {

struct PicturedShadows {
    std::string name; ///< of the picture's file, without its extension
    /// How bright each pixel is. 0: as dark as in shadow; 1: as bright as in light. The claim is
    /// `lit` from one half on.
    Image<float> lit_share;
    Image<std::uint8_t> decided; ///< 0 where the picture does not tell light from shadow: the claim
                                 ///< is then the truth, and the pixel is not judged
    bool antialiased = false;    ///< pixels across outlines lie between light and shadow
    std::uint64_t undecidable =
        0; ///< pixels that show a surface facing the light and are not decided
};

} // namespace shadowproof
