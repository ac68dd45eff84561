#include "compare/picture/reading/twin_order.h"

#include "compare/picture/reading/mesh_light.h"
#include "compare/picture/reading/observed_colors.h"
#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowproof {

double share_in_wrong_order(const GroundTruth& truth, const Picture& darker,
                            const Picture& brighter, double step) {
    constexpr int side = 8; // of a square, pixels
    std::size_t squares = 0;
    std::size_t wrong = 0;
    std::vector<double> excess; ///< by which the darker one is brighter, in steps
    for (int top = 0; top < darker.height; top += side)
        for (int left = 0; left < darker.width; left += side) {
            excess.clear();
            for (int y = top; y < std::min(top + side, darker.height); ++y)
                for (int x = left; x < std::min(left + side, darker.width); ++x) {
                    const std::size_t pixel = truth.triangle.index(x, y);
                    if (truth.triangle.pixels[pixel] == no_triangle) continue;
                    const double dark = glm::length(color_at(darker, pixel));
                    const double bright = glm::length(color_at(brighter, pixel));
                    if (!std::isfinite(dark) || !std::isfinite(bright)) continue;
                    const double least = std::max(step, float_step(std::max(dark, bright)));
                    excess.push_back(dark == bright ? 0 : (dark - bright) / least);
                }
            if (excess.empty()) continue;
            const auto middle = excess.begin() + std::ssize(excess) / 2;
            std::nth_element(excess.begin(), middle, excess.end());
            ++squares;
            wrong += *middle > fewest_steps ? 1U : 0U;
        }
    return squares == 0 ? 0 : static_cast<double>(wrong) / static_cast<double>(squares);
}

} // namespace shadowproof
