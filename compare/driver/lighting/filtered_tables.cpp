#include "compare/driver/lighting/filtered_tables.h"

#include "compare/driver/lighting/lighting_tables.h"
#include "scenes/surface/bump_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// A row's texels shared out among fewer: texel k of `coarse` spans [k, k + 1) * fine / coarse.
/// Each goes to one or, where it lies across a border, to two; none is wider than that.
struct SharedTexel {
    int first = 0;
    int second = 0;
    double to_first = 1; ///< share of the texel
};
SharedTexel shared(int texel, int fine, int coarse) {
    const auto scaled = [&](int at) { return std::int64_t{at} * coarse; };
    const auto first = static_cast<int>(scaled(texel) / fine);
    const auto end = scaled(texel + 1); // in units of 1 / fine of a coarse texel
    const auto border = std::int64_t{first + 1} * fine;
    if (end <= border) return {first, first, 1};
    return {first, first + 1, static_cast<double>(border - scaled(texel)) / coarse};
}

/// Texels go to those that cover them, weighted by how much of these they are. `of`: what is kept
/// of a texel.
template <class Texel, class Of>
Image<glm::dvec4> level_of(const Image<Texel>& texels, int level, const Of& of) {
    Image<glm::dvec4> made(std::max(1, texels.width >> level), std::max(1, texels.height >> level),
                           glm::dvec4(0));
    const double texel_share = static_cast<double>(made.width) / texels.width * made.height /
                               texels.height; // of a coarse texel
    for (int y = 0; y < texels.height; ++y) {
        const SharedTexel row = shared(y, texels.height, made.height);
        for (int x = 0; x < texels.width; ++x) {
            const SharedTexel column = shared(x, texels.width, made.width);
            const glm::dvec4 part = texel_share * of(texels.at(x, y));
            const auto give = [&](int to_x, int to_y, double share) {
                if (share > 0) made.at(to_x, to_y) += share * part;
            };
            give(column.first, row.first, column.to_first * row.to_first);
            give(column.second, row.first, (1 - column.to_first) * row.to_first);
            give(column.first, row.second, column.to_first * (1 - row.to_first));
            give(column.second, row.second, (1 - column.to_first) * (1 - row.to_first));
        }
    }
    return made;
}

glm::dvec4 unchanged(const glm::dvec4& mean) {
    return mean;
}

RangeOf<glm::dvec4> bounds_of(const Image<glm::vec4>& texels) {
    RangeOf<glm::dvec4> bounds = range_of(glm::dvec4(texels.at(0, 0)));
    for (const glm::vec4& texel : texels.pixels) bounds = hull(bounds, range_of(glm::dvec4(texel)));
    return bounds;
}

/// `of_mean`: what is kept of a mean.
template <class Texel, class Of, class OfMean>
ExpectedMipmap levels_of_texels(const Image<Texel>& texels, const Of& of, const OfMean& of_mean) {
    ExpectedMipmap made;
    const auto keep = [&](const Image<glm::dvec4>& level) {
        made.levels.push_back(converted<glm::vec4>(
            level, [&](const glm::dvec4& mean) { return glm::vec4(of_mean(mean)); }));
        made.bounds.push_back(bounds_of(made.levels.back()));
    };
    Image<glm::dvec4> level = level_of(texels, 0, of);
    keep(level);
    const int longest = std::max(texels.width, texels.height);
    for (int number = 1; (longest >> number) > 0; ++number) {
        // Of four texels each, the mean of means is that of all; odd sides have no such four.
        const bool in_fours = level.width % 2 == 0 && level.height % 2 == 0;
        level = in_fours ? level_of(level, 1, unchanged) : level_of(texels, number, of);
        keep(level);
    }
    return made;
}

glm::dvec3 direction_of(const glm::dvec3& n) {
    const double square = glm::dot(n, n);
    return square > 0 ? n / std::sqrt(square) : glm::dvec3(0, 0, 1);
}

glm::dvec2 slope_of(const glm::dvec3& normal) {
    const glm::dvec3 n = direction_of(normal);
    const double z = std::max(n.z, least_cosine_of_slopes);
    return {n.x / z, n.y / z};
}

} // namespace

ExpectedMipmap expected_mipmap(const Image<glm::vec4>& texels) {
    return levels_of_texels(
        texels, [](const glm::vec4& texel) { return glm::dvec4(texel); }, unchanged);
}

ExpectedPyramid expected_pyramid(const Scene& scene, const Material& material, BumpFilter filter) {
    const Image<glm::dvec3> normals =
        expected_normals(scene, scene.textures[material.bump_map], material);
    if (filter == BumpFilter::lean) {
        const auto moments = [](const glm::dvec3& normal) {
            const glm::dvec2 b = slope_of(normal);
            return glm::dvec4(b.x, b.y, b.x * b.x, b.y * b.y);
        };
        const auto product = [](const glm::dvec3& normal) {
            const glm::dvec2 b = slope_of(normal);
            return glm::dvec4(b.x * b.y, 0, 0, 1);
        };
        return {levels_of_texels(normals, moments, unchanged),
                levels_of_texels(normals, product, unchanged)};
    }
    const auto direction = [](const glm::dvec3& normal) {
        return glm::dvec4(direction_of(normal), 1);
    };
    const auto and_length = [](const glm::dvec4& mean) {
        return glm::dvec4(direction_of(glm::dvec3(mean)), glm::length(glm::dvec3(mean)));
    };
    if (filter == BumpFilter::dimmed) return {levels_of_texels(normals, direction, and_length), {}};
    return {levels_of_texels(normals, direction, unchanged), {}};
}

} // namespace shadowproof
