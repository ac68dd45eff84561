// The sides that the chosen light falls on, if nothing stands in its way, and that the eye sees.
#pragma once

#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowproof {

struct LitSides {
    std::vector<std::uint32_t> triangles; ///< ascending, first those that show shadows, then others
    std::size_t receivers = 0;            ///< of them: the first so many show shadows
};

/// Triangles whose side seen from the eye is the light's. None in whose plane one of both lies.
LitSides lit_sides(const Scene& scene);

} // namespace shadowproof
