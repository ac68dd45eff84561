// Parts of a picture. Hypotheses are compared on some of them before they are predicted for the
// whole.
#pragma once

#include "scenes/image.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// Pixels from left and top up to, but not including, right and bottom.
struct Patch {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

inline std::size_t area(const Patch& patch) {
    return static_cast<std::size_t>(patch.right - patch.left) *
           static_cast<std::size_t>(patch.bottom - patch.top);
}

/// Calls visit(x, y) for each pixel of a patch, in rows from the top.
template <class Visit>
void for_each_pixel(const Patch& patch, const Visit& visit) {
    for (int y = patch.top; y < patch.bottom; ++y)
        for (int x = patch.left; x < patch.right; ++x) visit(x, y);
}

/// The whole picture, in regions as RegionLedger takes them.
std::vector<Patch> all_patches(int width, int height);

/// Of these regions, `most` at most that have a wrong pixel and `most` of the others that have
/// decided ones, spread evenly in rows from the top. `wrong`, `decided`: not 0 where a pixel is.
std::vector<Patch> sampled_patches(const Image<std::uint8_t>& wrong,
                                   const Image<std::uint8_t>& decided, std::size_t most);

} // namespace shadowproof
