// PCX pictures made in the test itself.
#pragma once

#include "tests/scenes/small_gltf.h"

#include <array>
#include <cstdint>

namespace shadowproof::test {

/// Colour `i` of the palette of small_pcx.
std::array<std::uint8_t, 3> palette_color(int i);

/// 8 bits a pixel and a palette, as the game's tools write it: pixel (x, y) has the colour of
/// number (16 * y + x) % 256.
FileBytes small_pcx(int width, int height);

} // namespace shadowproof::test
