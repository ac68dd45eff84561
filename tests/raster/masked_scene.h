// Scenes with alpha masks, made by dice: a floor, sheets and closed boxes whose textures wrap,
// repeat and are read in all ways.
#pragma once

#include "scenes/scene.h"

#include <cstdint>

namespace shadowproof::tests {

/// 96x96 pixels, under a point light, a spot or a directional light by turns. The same for the same
/// seed.
Scene masked_scene(std::uint64_t seed);

/// A mask of so many texels a side, alpha 0 or 1 by halves, or anything between.
AlphaMask diced_mask(std::uint64_t seed);

} // namespace shadowproof::tests
