#include "scenes/surface/bump_pyramid.h"

#include "scenes/surface/mipmap.h"
#include "scenes/surface/relief.h"
#include "scenes/surface/texel_sides.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

glm::dvec3 unit_or_up(const glm::dvec3& n) {
    const double length = glm::length(n);
    return length > 0 ? n / length : glm::dvec3(0, 0, 1);
}

Image<glm::dvec3> unit_normals(const Scene& scene, const Material& material) {
    const TextureImage& map = scene.textures[material.bump_map];
    const double scale = material.bump_scale;
    if (material.bump == Bump::normal_map)
        return converted<glm::dvec3>(map.texels, [&](const glm::vec4& texel) {
            const glm::dvec3 m = 2.0 * glm::dvec3(texel) - 1.0;
            return unit_or_up({scale * m.x, scale * m.y, m.z});
        });
    const double side = material.height_in_space ? mean_texel_side(scene, material) : 1;
    return converted<glm::dvec3>(slopes_of(map, scale / side), [](const glm::dvec2& slope) {
        return unit_or_up({-slope.x, slope.y, 1});
    });
}

glm::dvec2 slopes_of_normal(const glm::dvec3& n) {
    return glm::dvec2(n) / std::max(n.z, least_cosine_of_slopes);
}

/// What is kept of a texel, or of a mean.
glm::vec4 kept_of_mean(const glm::dvec3& mean, BumpFilter filter) {
    if (filter != BumpFilter::dimmed) return {glm::vec3(mean), 1};
    return {glm::vec3(unit_or_up(mean)), static_cast<float>(glm::length(mean))};
}

} // namespace

BumpPyramid bump_pyramid(const Scene& scene, const Material& material, BumpFilter filter) {
    assert(filter != BumpFilter::none && material.bump != Bump::none);
    const Image<glm::dvec3> normals = unit_normals(scene, material);
    BumpPyramid pyramid;
    if (filter == BumpFilter::lean) {
        const auto moments = [](const glm::dvec3& n) {
            const glm::dvec2 b = slopes_of_normal(n);
            return glm::dvec4(b, b * b);
        };
        const auto product = [](const glm::dvec3& n) {
            const glm::dvec2 b = slopes_of_normal(n);
            return b.x * b.y;
        };
        visit_levels<glm::dvec4>(normals, moments, [&](const Image<glm::dvec4>& level) {
            pyramid.levels.push_back(converted<glm::vec4>(
                level, [](const glm::dvec4& mean) { return glm::vec4(mean); }));
        });
        visit_levels<double>(normals, product, [&](const Image<double>& level) {
            pyramid.cross.push_back(converted<glm::vec4>(
                level, [](double mean) { return glm::vec4(static_cast<float>(mean), 0, 0, 1); }));
        });
        return pyramid;
    }
    const auto unchanged = [](const glm::dvec3& n) { return n; };
    visit_levels<glm::dvec3>(normals, unchanged, [&](const Image<glm::dvec3>& level) {
        pyramid.levels.push_back(converted<glm::vec4>(
            level, [&](const glm::dvec3& mean) { return kept_of_mean(mean, filter); }));
    });
    return pyramid;
}

std::vector<Image<glm::vec4>> mipmap_of(const Image<glm::vec4>& texels) {
    std::vector<Image<glm::vec4>> levels;
    visit_levels<glm::dvec4>(
        texels, [](const glm::vec4& texel) { return glm::dvec4(texel); },
        [&](const Image<glm::dvec4>& level) {
            levels.push_back(converted<glm::vec4>(
                level, [](const glm::dvec4& mean) { return glm::vec4(mean); }));
        });
    return levels;
}

} // namespace shadowproof
