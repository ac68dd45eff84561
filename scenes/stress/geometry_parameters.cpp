#include "scenes/stress/parameters.h"
#include "scenes/stress/place.h"
#include "scenes/stress/replaced_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

double one(const Scene& /*scene*/) {
    return 1;
}

/// Eye, lights and vertices, each through the same function of doubles.
template <class Move>
void move_all(Scene& scene, const Move& move) {
    for (glm::vec3& position : scene.positions) position = glm::vec3(move(glm::dvec3(position)));
    scene.camera.eye = move(scene.camera.eye);
    for (Light& light : scene.lights) light.position = move(light.position);
}

void take_origin_distance(Scene& scene, double value) {
    const glm::dvec3 offset(value * size_of(scene) / std::sqrt(3.0));
    move_all(scene, [&](const glm::dvec3& point) { return point + offset; });
}

void take_scale(Scene& scene, double value) {
    move_all(scene, [&](const glm::dvec3& point) { return value * point; });
    scene.camera.near *= value;
    scene.camera.far *= value;
    if (scene.camera.is_orthographic()) scene.camera.half_height *= value;
    if (scene.inverse_square) // the light that arrives stays the same
        for (Light& light : scene.lights) light.intensity *= value * value;
}

/// A new vertex within the triangle, so near the middle of its longest edge that this edge is so
/// many times as long as the vertex is off it. Neighbours are not touched: no T-junctions.
void add_sliver(Scene& scene, std::uint32_t number, double aspect,
                std::vector<glm::uvec3>& triangles) {
    glm::uvec3 t = scene.triangles[number];
    const auto length = [&](int k) {
        return glm::distance(corner(scene, number, k), corner(scene, number, (k + 1) % 3));
    };
    int longest = 0;
    for (const int k : {1, 2})
        if (length(k) > length(longest)) longest = k;
    t = {t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
    const glm::dvec3 a = scene.positions[t.x];
    const glm::dvec3 b = scene.positions[t.y];
    const glm::dvec3 c = scene.positions[t.z];
    const glm::dvec3 middle = 0.5 * (a + b);
    const glm::dvec3 along = unit_or(b - a, {1, 0, 0});
    const double height = glm::length(c - middle - glm::dot(c - middle, along) * along);
    const double share =
        height > 0 ? std::min(1.0 / 3, glm::distance(a, b) / (aspect * height)) : 1.0 / 3;
    const auto vertex = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.emplace_back(middle + share * (c - middle));
    triangles.insert(triangles.end(), {{t.x, t.y, vertex}, {t.y, t.z, vertex}, {t.z, t.x, vertex}});
}

void take_sliver_aspect(Scene& scene, double value) {
    replace_triangles(
        scene, [](const Mesh& mesh) { return mesh.casts; },
        [&](std::uint32_t number, std::vector<glm::uvec3>& triangles) {
            add_sliver(scene, number, value, triangles);
        });
}

void take_coincident_faces(Scene& scene, double value) {
    replace_triangles(
        scene, [](const Mesh& mesh) { return mesh.casts; },
        [&](std::uint32_t number, std::vector<glm::uvec3>& triangles) {
            triangles.insert(triangles.end(), static_cast<std::size_t>(value),
                             scene.triangles[number]);
        });
}

/// Further casters between the main one and the light: scaled about a light that has a place, up to
/// half its distance; moved towards a directional one by up to the caster's diagonal.
void take_nested_volumes(Scene& scene, double value) {
    const auto count = static_cast<std::uint32_t>(value);
    const std::uint32_t caster = *main_caster(scene);
    const Light light = chosen_light(scene);
    const double diagonal = diagonal_of(scene, scene.meshes[caster]);
    const auto moved = [&](const glm::dvec3& point, double share) {
        return light.kind == Light::Kind::directional
                   ? point - share * diagonal * light.direction
                   : light.position + (1 - 0.5 * share) * (point - light.position);
    };
    replace_triangles(
        scene, [&](const Mesh& mesh) { return &mesh == &scene.meshes[caster]; },
        [&](std::uint32_t number, std::vector<glm::uvec3>& triangles) {
            triangles.push_back(scene.triangles[number]);
            for (std::uint32_t i = 1; i < count; ++i) {
                glm::uvec3 copy{};
                for (int k = 0; k < 3; ++k) {
                    copy[k] = static_cast<std::uint32_t>(scene.positions.size());
                    scene.positions.emplace_back(
                        moved(corner(scene, number, k), static_cast<double>(i) / count));
                }
                triangles.push_back(copy);
            }
        });
}

bool has_zeros(const Scene& scene) {
    return std::ranges::any_of(scene.positions,
                               [](const glm::vec3& p) { return p.x == 0 || p.y == 0 || p.z == 0; });
}

void take_zero(Scene& scene, double value) {
    const auto small = static_cast<float>(value);
    for (glm::vec3& position : scene.positions)
        for (int k = 0; k < 3; ++k)
            if (position[k] == 0) position[k] = small;
}

void take_bump_slope(Scene& scene, double value) {
    for (Material& material : scene.materials) material.bump_scale *= value;
}

void take_texel_density(Scene& scene, double value) {
    for (Surface& surface : scene.surfaces) {
        surface.decal_at = glm::vec2(value * glm::dvec2(surface.decal_at));
        surface.bump_at = glm::vec2(value * glm::dvec2(surface.bump_at));
    }
}

} // namespace

std::vector<StressParameter> geometry_parameters() {
    return {
        {.name = "origin_distance",
         .words = "of the whole scene, in its sizes",
         .high = 1e8,
         .suits = any_scene,
         .own = [](const Scene&) { return 0.1; },
         .take = take_origin_distance},
        {.name = "scale",
         .words = "a factor for all lengths",
         .low = 1e-6,
         .high = 1e6,
         .suits = any_scene,
         .own = one,
         .take = take_scale},
        {.name = "sliver_aspect",
         .words = "the longest edge of a new triangle in each that casts, over its height",
         .high = 1e9,
         .suits = has_caster_without_bumps,
         .own = one,
         .take = take_sliver_aspect},
        {.name = "coincident_faces",
         .words = "how often each triangle that casts is there",
         .high = 64,
         .whole = true,
         .suits = has_caster_without_bumps,
         .own = one,
         .take = take_coincident_faces},
        {.name = "nested_volumes",
         .words = "the main caster and its copies between it and the light",
         .high = 1000,
         .whole = true,
         .suits = has_caster_without_bumps,
         .own = one,
         .take = take_nested_volumes},
        {.name = "denormal",
         .words = "what coordinates of 0 become",
         .low = 1e-45,
         .suits = has_zeros,
         .own = [](const Scene&) { return 1e-9; },
         .take = take_zero},
        {.name = "bump_slope",
         .words = "a factor for the slopes of bumps",
         .low = 1e-3,
         .high = 1e4,
         .suits = is_bump_lit,
         .own = one,
         .take = take_bump_slope},
        {.name = "texel_density",
         .words = "a factor for texture coordinates",
         .low = 1e-4,
         .high = 1e4,
         .suits = is_bump_lit,
         .own = one,
         .take = take_texel_density},
    };
}

} // namespace shadowproof
