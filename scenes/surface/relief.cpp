#include "scenes/surface/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

namespace {

/// The texels before and after each texel along an axis. Beyond an end: the texel of the opposite
/// end (repeat), else the end texel itself.
struct Neighbours {
    int before = 0;
    int behind = 0;
};

Neighbours neighbours_of(int texel, int texels, Wrap wrap) {
    const bool around = wrap == Wrap::repeat;
    return {texel > 0 ? texel - 1 : (around ? texels - 1 : 0),
            texel + 1 < texels ? texel + 1 : (around ? 0 : texels - 1)};
}

} // namespace

Image<glm::dvec2> slopes_of(const Image<double>& heights, Wrap wrap_s, Wrap wrap_t, double scale) {
    Image<glm::dvec2> slopes(heights.width, heights.height);
    for (int y = 0; y < slopes.height; ++y) {
        const Neighbours rows = neighbours_of(y, heights.height, wrap_t);
        for (int x = 0; x < slopes.width; ++x) {
            const Neighbours columns = neighbours_of(x, heights.width, wrap_s);
            slopes.at(x, y) =
                scale / 2 *
                glm::dvec2(heights.at(columns.behind, y) - heights.at(columns.before, y),
                           heights.at(x, rows.behind) - heights.at(x, rows.before));
        }
    }
    return slopes;
}

Image<glm::dvec2> slopes_of(const TextureImage& heights, double scale) {
    const auto red =
        converted<double>(heights.texels, [](const glm::vec4& texel) { return texel.r; });
    return slopes_of(red, heights.wrap_s, heights.wrap_t, scale);
}

int levels_of(int width, int height) {
    int levels = 1;
    for (int size = std::max(width, height); size > 1; size /= 2) ++levels;
    return levels;
}

namespace {

/// The texels of `fine` that a texel of `coarse` covers, and the share of it that each covers;
/// their sum is 1.
struct Share {
    int texel = 0;
    double weight = 0;
};

std::vector<Share> shares_of(int texel, int coarse, int fine) {
    const double size = static_cast<double>(fine) / coarse; // in fine texels
    const double begin = texel * size;
    const double end = begin + size;
    std::vector<Share> shares;
    for (int i = static_cast<int>(begin); i < fine && i < end; ++i) {
        const double covered = std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i));
        if (covered > 0) shares.push_back({i, covered / size});
    }
    return shares;
}

glm::dvec3 normal_of_slope(const glm::dvec2& slope) {
    return glm::normalize(glm::dvec3(-slope.x, slope.y, 1));
}

} // namespace

Image<glm::dvec4> normal_map_of(const Image<glm::dvec2>& slopes, int level) {
    const auto normals = converted<glm::dvec3>(slopes, normal_of_slope);
    Image<glm::dvec4> map(std::max(1, slopes.width >> level), std::max(1, slopes.height >> level));
    for (int y = 0; y < map.height; ++y) {
        const std::vector<Share> rows = shares_of(y, map.height, slopes.height);
        for (int x = 0; x < map.width; ++x) {
            glm::dvec3 mean(0);
            for (const Share& column : shares_of(x, map.width, slopes.width))
                for (const Share& row : rows)
                    mean += row.weight * column.weight * normals.at(column.texel, row.texel);
            const double length = level == 0 ? 1 : glm::length(mean);
            const glm::dvec3 n = length > 0 ? mean / length : glm::dvec3(0, 0, 1);
            map.at(x, y) = glm::dvec4(0.5 + 0.5 * n, length);
        }
    }
    return map;
}

} // namespace shadowproof
