#include "scenes/surface/bump_forms.h"

#include "scenes/error.h"
#include "scenes/surface/relief.h"
#include "scenes/surface/texel_sides.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

namespace shadowproof {

namespace {

/// Rounded to k / 255, of a number in [0, 1].
float in_bytes(double number) {
    return static_cast<float>(std::round(255 * number) / 255);
}

Error refusal(const Scene& scene, const Material& material, const std::string& what,
              const std::string& remedy) {
    return {scene.file.string() + ": material '" + material.name + "'", what, remedy};
}

/// The normal of a normal map's texel, not normalised.
glm::dvec3 normal_of(const glm::vec4& texel, double scale) {
    const glm::dvec3 m = 2.0 * glm::dvec3(texel) - 1.0;
    return {scale * m.x, scale * m.y, m.z};
}

/// As BumpTexels::texel_side.
double texel_side(const Scene& scene, const Material& material) {
    return material.height_in_space ? mean_texel_side(scene, material) : 0;
}

/// Of heights: how many texels 1 stands for.
double scale_in_texels(const Scene& scene, const Material& material) {
    const double side = texel_side(scene, material);
    return side > 0 ? material.bump_scale / side : material.bump_scale;
}

/// The normals at a bump map's texels, not normalised.
Image<glm::dvec3> normals_of(const Scene& scene, const TextureImage& map,
                             const Material& material) {
    if (material.bump == Bump::normal_map)
        return converted<glm::dvec3>(map.texels, [&](const glm::vec4& texel) {
            return normal_of(texel, material.bump_scale);
        });
    return converted<glm::dvec3>(
        slopes_of(map, scale_in_texels(scene, material)),
        [](const glm::dvec2& slope) { return glm::dvec3(-slope.x, slope.y, 1); });
}

BumpTexels as_heights(const Scene& scene, const Material& material, const TextureImage& map) {
    if (material.bump != Bump::height_field)
        throw refusal(scene, material, "has normals, of which no heights are made",
                      "ask for another form of bumps than height-field");
    return {.form = BumpForm::height_field,
            .texels = map.texels,
            .scale = scale_in_texels(scene, material),
            .texel_side = texel_side(scene, material)};
}

BumpTexels as_normals(const Scene& scene, const Material& material, const TextureImage& map) {
    if (material.bump == Bump::normal_map)
        return {.form = BumpForm::normal_map, .texels = map.texels, .scale = material.bump_scale};
    const auto normals = normal_map_of(slopes_of(map, scale_in_texels(scene, material)));
    return {.form = BumpForm::normal_map,
            .texels = converted<glm::vec4>(normals, [](const glm::dvec4& n) {
                return glm::vec4(in_bytes(n.x), in_bytes(n.y), in_bytes(n.z), 1);
            })};
}

BumpTexels as_derivatives(const Scene& scene, const Material& material, const TextureImage& map) {
    const Image<glm::dvec3> normals = normals_of(scene, map, material);
    if (!std::ranges::all_of(normals.pixels, [](const glm::dvec3& n) { return n.z > 0; }))
        throw refusal(scene, material, "has normals without a slope, along the surface or into it",
                      "ask for another form of bumps than derivatives");
    const auto slopes = converted<glm::dvec2>(
        normals, [](const glm::dvec3& n) { return glm::dvec2(-n.x, n.y) / n.z; });
    double range = 0;
    for (const glm::dvec2& slope : slopes.pixels)
        range = std::max({range, std::abs(slope.x), std::abs(slope.y)});
    if (range == 0) range = 1; // flat: any will do
    return {.form = BumpForm::derivatives,
            .texels = converted<glm::vec4>(slopes,
                                           [&](const glm::dvec2& slope) {
                                               const glm::dvec2 st = 0.5 + 0.5 / range * slope;
                                               return glm::vec4(in_bytes(st.x), in_bytes(st.y), 0,
                                                                1);
                                           }),
            .slope_range = range,
            .texel_side = texel_side(scene, material)};
}

BumpTexels as_numbers(const Scene& scene, const Material& material, const TextureImage& map) {
    return {.form = BumpForm::indexed,
            .texels =
                converted<glm::vec4>(normals_of(scene, map, material), [](const glm::dvec3& n) {
                    return glm::vec4(number_of(n), 0, 0, 1);
                })};
}

/// Maps between the octahedron's lower half, seen from above, and what lies outside its upper half:
/// each is the other mirrored in the nearest of the four edges.
glm::dvec2 folded(const glm::dvec2& p) {
    return {(1 - std::abs(p.y)) * (p.x < 0 ? -1 : 1), (1 - std::abs(p.x)) * (p.y < 0 ? -1 : 1)};
}

} // namespace

BumpTexels bump_texels(const Scene& scene, const Material& material, BumpForm form) {
    assert(material.bump != Bump::none);
    const TextureImage& map = scene.textures[material.bump_map];
    if (form == BumpForm::as_given)
        form = material.bump == Bump::height_field ? BumpForm::height_field : BumpForm::normal_map;
    switch (form) {
    case BumpForm::height_field:
        return as_heights(scene, material, map);
    case BumpForm::derivatives:
        return as_derivatives(scene, material, map);
    case BumpForm::indexed:
        return as_numbers(scene, material, map);
    case BumpForm::as_given:
    case BumpForm::normal_map:
        break;
    }
    return as_normals(scene, material, map);
}

glm::dvec3 indexed_normal(std::uint16_t number) {
    const glm::dvec2 p = 2.0 / 255 * glm::dvec2(number % 256, number / 256) - 1.0;
    const double z = 1 - std::abs(p.x) - std::abs(p.y);
    return glm::normalize(glm::dvec3(z < 0 ? folded(p) : p, z));
}

std::uint16_t number_of(const glm::dvec3& normal) {
    const double size = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    if (!(size > 0)) return number_of({0, 0, 1});
    glm::dvec2 p = glm::dvec2(normal) / size;
    if (normal.z < 0) p = folded(p);
    const glm::dvec2 bytes = glm::round(255.0 * (0.5 + 0.5 * p));
    return static_cast<std::uint16_t>(256 * bytes.y + bytes.x);
}

} // namespace shadowproof
