#include "scenes/surface/mipmap.h"

#include <cstddef>

namespace shadowproof {

int levels_of(int width, int height) {
    int levels = 1;
    for (int size = std::max(width, height); size > 1; size /= 2) ++levels;
    return levels;
}

std::vector<std::vector<Covered>> covered_by(int coarse, int fine) {
    const double size = static_cast<double>(fine) / coarse; // in fine texels
    std::vector<std::vector<Covered>> covered(static_cast<std::size_t>(coarse));
    for (int texel = 0; texel < coarse; ++texel) {
        const double begin = texel * size;
        const double end = begin + size;
        for (int i = static_cast<int>(begin); i < fine && i < end; ++i) {
            const double across = std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i));
            if (across > 0) covered[static_cast<std::size_t>(texel)].push_back({i, across / size});
        }
    }
    return covered;
}

} // namespace shadowproof
