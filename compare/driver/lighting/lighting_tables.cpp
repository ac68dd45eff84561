#include "compare/driver/lighting/lighting_tables.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

/// The nearest of 0 to 255 to a number in [0, 1]; halves go up.
int nearest_byte(double number) {
    return static_cast<int>(std::floor(255 * number + 0.5));
}
float stored_in_byte(double number) {
    return static_cast<float>(nearest_byte(number) / 255.0);
}
/// Of a component in [-1, 1].
int byte_of_component(double component) {
    return nearest_byte((component + 1) / 2);
}

float component_in_byte(double component) {
    return static_cast<float>(byte_of_component(component) / 255.0);
}

/// The texel `step` beside another in a row or column of `count`.
int beside(int texel, int step, int count, Wrap wrap) {
    const int other = texel + step;
    if (other >= 0 && other < count) return other;
    return wrap == Wrap::repeat ? (other + count) % count : texel;
}

glm::dvec3 to_unit(double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length};
}

/// The side of a square texel, were all triangles of the material to have texels of one size; 0
/// where heights are in texels. Areas by the halved cross products of corners' differences; in the
/// texture by the shoelace formula.
double expected_texel_side(const Scene& scene, const Material& material) {
    if (!material.height_in_space) return 0;
    const Image<glm::vec4>& texels = scene.textures[material.bump_map].texels;
    double space = 0;
    double texture = 0;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        const Mesh& mesh = scene.meshes[mesh_of(scene, triangle)];
        if (&scene.materials[mesh.material] != &material) continue;
        const glm::dvec3 last = corner(scene, triangle, 2);
        space += 0.5 * glm::length(glm::cross(corner(scene, triangle, 0) - last,
                                              corner(scene, triangle, 1) - last));
        double twice = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 at(scene.surfaces[std::size_t{3} * triangle + k].bump_at);
            const glm::dvec2 next(scene.surfaces[std::size_t{3} * triangle + (k + 1) % 3].bump_at);
            twice += at.x * next.y - next.x * at.y;
        }
        texture += 0.5 * std::abs(twice) * texels.width * texels.height;
    }
    const double side = std::sqrt(space / texture);
    return side > 0 && std::isfinite(side) ? side : 1;
}

BumpTexels empty_texels(BumpForm form, const TextureImage& map) {
    return {.form = form, .texels = Image<glm::vec4>(map.texels.width, map.texels.height)};
}

BumpTexels normals_in_bytes(const Image<glm::dvec3>& normals, BumpTexels made) {
    for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
        const glm::dvec3& n = normals.pixels[i];
        const glm::dvec3 unit = to_unit(n.x, n.y, n.z);
        made.texels.pixels[i] = {component_in_byte(unit.x), component_in_byte(unit.y),
                                 component_in_byte(unit.z), 1};
    }
    return made;
}

BumpTexels slopes_in_bytes(const Image<glm::dvec3>& normals, BumpTexels made) {
    double range = 0;
    for (const glm::dvec3& n : normals.pixels)
        range = std::max({range, std::abs(n.x / n.z), std::abs(n.y / n.z)});
    made.slope_range = range > 0 ? range : 1;
    for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
        const glm::dvec3& n = normals.pixels[i];
        made.texels.pixels[i] = {stored_in_byte(0.5 - n.x / n.z / (2 * made.slope_range)),
                                 stored_in_byte(0.5 + n.y / n.z / (2 * made.slope_range)), 0, 1};
    }
    return made;
}

/// A point of the octahedron |x| + |y| + |z| = 1 seen from above, its lower half folded outwards
/// over the upper half's four edges.
struct OctahedralPlace {
    double u = 0;
    double v = 0;

    OctahedralPlace folded() const {
        return {std::copysign(1 - std::abs(v), u < 0 ? -1.0 : 1.0),
                std::copysign(1 - std::abs(u), v < 0 ? -1.0 : 1.0)};
    }
};

BumpTexels numbers_of_normals(const Image<glm::dvec3>& normals, BumpTexels made) {
    for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
        glm::dvec3 n = normals.pixels[i];
        double size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
        if (!(size > 0)) {
            n = {0, 0, 1};
            size = 1;
        }
        OctahedralPlace place{n.x / size, n.y / size};
        if (n.z < 0) place = place.folded();
        made.texels.pixels[i] = {
            static_cast<float>(byte_of_component(place.v) * 256 + byte_of_component(place.u)), 0, 0,
            1};
    }
    return made;
}

} // namespace

Image<glm::dvec2> expected_slopes(const TextureImage& heights, double scale) {
    const int width = heights.texels.width;
    const int height = heights.texels.height;
    Image<glm::dvec2> slopes(width, height);
    const auto at = [&](int x, int y) { return double{heights.texels.at(x, y).r}; };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double along = at(beside(x, 1, width, heights.wrap_s), y) -
                                 at(beside(x, -1, width, heights.wrap_s), y);
            const double down = at(x, beside(y, 1, height, heights.wrap_t)) -
                                at(x, beside(y, -1, height, heights.wrap_t));
            slopes.at(x, y) = {along * (scale / 2), down * (scale / 2)};
        }
    return slopes;
}

Image<glm::dvec3> expected_normals(const Scene& scene, const TextureImage& map,
                                   const Material& material) {
    Image<glm::dvec3> normals(map.texels.width, map.texels.height);
    if (material.bump == Bump::normal_map) {
        for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
            const glm::vec4& texel = map.texels.pixels[i];
            normals.pixels[i] = {material.bump_scale * (2 * double{texel.r} - 1),
                                 material.bump_scale * (2 * double{texel.g} - 1),
                                 2 * double{texel.b} - 1};
        }
        return normals;
    }
    const double side = expected_texel_side(scene, material);
    const Image<glm::dvec2> slopes =
        expected_slopes(map, side > 0 ? material.bump_scale / side : material.bump_scale);
    for (std::size_t i = 0; i < normals.pixels.size(); ++i)
        normals.pixels[i] = {-slopes.pixels[i].x, slopes.pixels[i].y, 1};
    return normals;
}

BumpTexels expected_bump_texels(const Scene& scene, const Material& material, BumpForm form) {
    assert(material.bump != Bump::none);
    const TextureImage& map = scene.textures[material.bump_map];
    const bool heights = material.bump == Bump::height_field;
    if (form == BumpForm::as_given) form = heights ? BumpForm::height_field : BumpForm::normal_map;
    const bool given = form == (heights ? BumpForm::height_field : BumpForm::normal_map);
    const double side = expected_texel_side(scene, material);
    if (given)
        return {.form = form,
                .texels = map.texels,
                .scale = side > 0 ? material.bump_scale / side : material.bump_scale,
                .texel_side = side};
    const Image<glm::dvec3> normals = expected_normals(scene, map, material);
    if (form == BumpForm::derivatives) {
        BumpTexels made = empty_texels(form, map);
        made.texel_side = side;
        return slopes_in_bytes(normals, std::move(made));
    }
    if (form == BumpForm::indexed) return numbers_of_normals(normals, empty_texels(form, map));
    return normals_in_bytes(normals, empty_texels(form, map));
}

glm::dvec3 expected_normal(std::uint16_t number) {
    OctahedralPlace place{(number & 0xffU) / 127.5 - 1, (number >> 8U) / 127.5 - 1};
    const double z = 1 - std::abs(place.u) - std::abs(place.v);
    if (z < 0) place = place.folded();
    return to_unit(place.u, place.v, z);
}

// Combinations of two edges, from the last corner, that step by one texel in s or t and by none in
// the other.
ExpectedTexelSides expected_texel_sides(const Scene& scene, std::uint32_t triangle) {
    const Material& material = scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
    const Image<glm::vec4>& texels = scene.textures[material.bump_map].texels;
    const Surface* const corners = &scene.surfaces[std::size_t{3} * triangle];
    const auto place = [&](int k) {
        return glm::dvec2(corners[k].bump_at) * glm::dvec2(texels.width, texels.height);
    };
    const glm::dvec3 to_a = corner(scene, triangle, 0) - corner(scene, triangle, 2);
    const glm::dvec3 to_b = corner(scene, triangle, 1) - corner(scene, triangle, 2);
    const glm::dvec2 a = place(0) - place(2);
    const glm::dvec2 b = place(1) - place(2);
    const double both = a.x * b.y - a.y * b.x;
    if (both == 0) return {};
    return {(b.y * to_a - a.y * to_b) / both, (a.x * to_b - b.x * to_a) / both};
}

std::vector<Surface> expected_polygon_surfaces(const Scene& scene) {
    std::vector<Surface> surfaces = scene.surfaces;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        const Mesh& mesh = scene.meshes[mesh_of(scene, triangle)];
        if (scene.materials[mesh.material].bump == Bump::none) continue;
        const glm::dvec3 along = expected_texel_sides(scene, triangle).along;
        const double length = glm::length(along);
        if (!(length > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            glm::vec4& tangent = surfaces[std::size_t{3} * triangle + k].tangent;
            tangent = glm::vec4(glm::vec3(along / length), tangent.w);
        }
    }
    return surfaces;
}

NormalisationCube expected_normalisation_cube(int size) {
    NormalisationCube cube{size, {}};
    for (std::size_t face = 0; face < cube.faces.size(); ++face) {
        cube.faces[face] = Image<glm::u8vec3>(size, size);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const auto place = [&](int texel) { return 2 * (texel + 0.5) / size - 1; };
                const glm::dvec3 way = through(face, place(x), place(y));
                const glm::dvec3 unit = to_unit(way.x, way.y, way.z);
                cube.faces[face].at(x, y) = {byte_of_component(unit.x), byte_of_component(unit.y),
                                             byte_of_component(unit.z)};
            }
    }
    return cube;
}

} // namespace shadowproof
