#include "scenes/surface/relief.h"

#include "scenes/surface/mipmap.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

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

namespace {

glm::dvec3 normal_of_slope(const glm::dvec2& slope) {
    return glm::normalize(glm::dvec3(-slope.x, slope.y, 1));
}

} // namespace

Image<glm::dvec4> normal_map_of(const Image<glm::dvec2>& slopes, int level) {
    const auto normals = converted<glm::dvec3>(slopes, normal_of_slope);
    const auto means =
        mipmap_level<glm::dvec3>(normals, level, [](const glm::dvec3& normal) { return normal; });
    return converted<glm::dvec4>(means, [&](const glm::dvec3& mean) {
        const double length = level == 0 ? 1 : glm::length(mean);
        const glm::dvec3 n = length > 0 ? mean / length : glm::dvec3(0, 0, 1);
        return glm::dvec4(0.5 + 0.5 * n, length);
    });
}

} // namespace shadowproof
