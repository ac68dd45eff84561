// How another program may read an alpha mask.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace shadowproof {

/// What another program's reading of a mask may be off by.
struct MaskError {
    glm::dvec2 at{0, 0}; ///< of the texture coordinates
    double alpha = 0;
};

/// Which of the answers that another program may give.
enum class MaskReading : std::uint8_t {
    exact,
    most, ///< the surface stands wherever it may
    least ///< and only where it must
};

} // namespace shadowproof
