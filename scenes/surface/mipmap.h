// Mipmaps: a picture in half, a quarter, an eighth ... of its size, each texel the mean of all that
// it covers (Williams 1983).
#pragma once

#include "scenes/image.h"

#include <algorithm>
#include <vector>

namespace shadowproof {

/// Number of mipmap levels of a picture, down to a single texel.
int levels_of(int width, int height);

/// Texels of a row (or a column) that are covered by one of a coarser level's row, and the share of
/// it that each covers; the shares' sum is 1.
struct Covered {
    int texel = 0;
    double share = 0;
};
/// Of each texel of a row of `coarse` texels, over one of `fine`.
std::vector<std::vector<Covered>> covered_by(int coarse, int fine);

/// A level: its size is max(1, size / 2^level), rounded down as OpenGL has it, and each of its
/// texels is the mean of all texels of level 0 that it covers, each weighted by its area. `of`: of
/// a texel of level 0, the value whose mean is taken, which can be added and multiplied by a
/// number.
template <class Value, class Texel, class Of>
Image<Value> mipmap_level(const Image<Texel>& texels, int level, const Of& of) {
    Image<Value> made(std::max(1, texels.width >> level), std::max(1, texels.height >> level));
    const auto columns = covered_by(made.width, texels.width);
    const auto rows = covered_by(made.height, texels.height);
    for (int y = 0; y < made.height; ++y)
        for (int x = 0; x < made.width; ++x) {
            Value mean(0);
            for (const Covered& row : rows[static_cast<std::size_t>(y)])
                for (const Covered& column : columns[static_cast<std::size_t>(x)])
                    mean += row.share * column.share * of(texels.at(column.texel, row.texel));
            made.at(x, y) = mean;
        }
    return made;
}

/// Whether a row of `fine` texels is that of `coarse` ones in halves.
inline bool is_halved(int fine, int coarse) {
    return fine == 2 * coarse || (fine == 1 && coarse == 1);
}

/// Calls visit(level's picture) for each level, from the finest. Where all sides are halved, a
/// level is made of the one before, whose means it covers alike; else of level 0.
template <class Value, class Texel, class Of, class Visit>
void visit_levels(const Image<Texel>& texels, const Of& of, const Visit& visit) {
    auto level = converted<Value>(texels, of);
    visit(level);
    for (int number = 1; number < levels_of(texels.width, texels.height); ++number) {
        const int width = std::max(1, texels.width >> number);
        const int height = std::max(1, texels.height >> number);
        level = is_halved(level.width, width) && is_halved(level.height, height)
                    ? mipmap_level<Value>(level, 1, [](const Value& mean) { return mean; })
                    : mipmap_level<Value>(texels, number, of);
        visit(level);
    }
}

} // namespace shadowproof
