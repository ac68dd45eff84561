// The triangle sides that the eye sees and that the chosen light illuminates wherever nothing
// shadows them.
#pragma once

#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowproof {

struct LitSides {
    std::vector<std::uint32_t> triangles; ///< ascending; those that receive shadows come first
    std::size_t receivers = 0;            ///< how many of them receive shadows
};

/// The triangles whose visible side is the one that faces the light, excluding those whose plane
/// contains the eye or the light.
LitSides lit_sides(const Scene& scene);

} // namespace shadowproof
