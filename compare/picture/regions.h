// Connected regions of wrong pixels: where they are, and which caster's shadow on which receiver is
// wrong.
#pragma once

#include "reference/predict/traced_scene.h"
#include "scenes/frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

struct WrongRegion {
    std::uint64_t pixels = 0;
    int left = 0; ///< of the rectangle around it
    int top = 0;
    int right = 0; ///< the last column, and row
    int bottom = 0;
    std::string receiver{}; ///< the mesh that most of its pixels see
    std::string caster{};   ///< whose shadow most of it lacks; empty: none is missing
    std::string words{};    ///< "45 pixels from (12,40) to (20,46): the shadow of torus on floor is
                            ///< lit"
};

/// The largest, by pixels, of the regions into which the flagged pixels fall; pixels are connected
/// if they have a side or a corner in common and show the same class.
std::vector<WrongRegion> largest_regions(const TracedScene& traced, const Frame& frame,
                                         const Image<std::uint8_t>& flags, std::size_t most);

} // namespace shadowproof
