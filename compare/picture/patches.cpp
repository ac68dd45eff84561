#include "compare/picture/patches.h"

#include "reference/predict/region_ledger.h"

#include <algorithm>

namespace shadowproof {

namespace {

/// Every so many of them, so that `most` are left at most.
void add_spread(const std::vector<Patch>& from, std::size_t most, std::vector<Patch>& to) {
    const std::size_t step = (from.size() + most - 1) / most;
    for (std::size_t i = 0; i < from.size(); i += step) to.push_back(from[i]);
}

bool has_any(const Image<std::uint8_t>& flags, const Patch& patch) {
    bool any = false;
    for_each_pixel(patch, [&](int x, int y) { any = any || flags.at(x, y) != 0; });
    return any;
}

} // namespace

std::vector<Patch> all_patches(int width, int height) {
    std::vector<Patch> all;
    for (int top = 0; top < height; top += region_side)
        for (int left = 0; left < width; left += region_side)
            all.push_back({left, top, std::min(left + region_side, width),
                           std::min(top + region_side, height)});
    return all;
}

std::vector<Patch> sampled_patches(const Image<std::uint8_t>& wrong,
                                   const Image<std::uint8_t>& decided, std::size_t most) {
    std::vector<Patch> with_wrong;
    std::vector<Patch> others;
    for (const Patch& patch : all_patches(wrong.width, wrong.height))
        if (has_any(wrong, patch))
            with_wrong.push_back(patch);
        else if (has_any(decided, patch))
            others.push_back(patch);
    std::vector<Patch> sample;
    add_spread(with_wrong, most, sample);
    add_spread(others, most, sample);
    return sample;
}

} // namespace shadowproof
