#include "tests/odd_geometry/random_scenes.h"

#include "tests/raster/small_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof::tests {

namespace {

glm::dvec3 anywhere(Dice& dice, double reach) {
    return {dice.between(-reach, reach), dice.between(-reach, reach), dice.between(-reach, reach)};
}

/// To quarters, where more lies in one plane or on one line than elsewhere.
glm::vec3 on_lattice(const glm::dvec3& place) {
    return glm::round(place * 4.0) / 4.0;
}

void add_mesh(Scene& scene, const std::string& name, const std::vector<glm::vec3>& positions,
              const std::vector<glm::uvec3>& triangles) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.meshes.push_back({.name = name,
                            .first_triangle = static_cast<std::uint32_t>(scene.triangles.size()),
                            .triangle_count = static_cast<std::uint32_t>(triangles.size())});
    scene.positions.insert(scene.positions.end(), positions.begin(), positions.end());
    for (const glm::uvec3& triangle : triangles) scene.triangles.push_back(triangle + first);
}

/// A prism over a regular polygon, or over a star, which is concave; turned, and stretched. Closed,
/// its outside in front.
void add_body(Scene& scene, Dice& dice, bool lattice) {
    const auto corners = static_cast<std::uint32_t>(3 + dice.below(5));
    const bool star = dice.one_in(2);
    const std::uint32_t around = star ? 2 * corners : corners;
    const glm::dquat turn = glm::normalize(glm::dquat(dice.between(-1, 1), anywhere(dice, 1)));
    const glm::dvec3 size{dice.between(0.3, 2), dice.between(0.1, 2), dice.between(0.3, 2)};
    const glm::dvec3 middle = anywhere(dice, 2.5);
    std::vector<glm::vec3> positions;
    const auto add = [&](const glm::dvec3& place) {
        const glm::dvec3 placed = middle + turn * (size * place);
        positions.push_back(lattice ? on_lattice(placed) : glm::vec3(placed));
    };
    for (const double y : {-1.0, 1.0}) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = glm::two_pi<double>() * i / around;
            const double radius = star && i % 2 == 1 ? 0.4 : 1.0;
            add({radius * std::cos(angle), y, radius * std::sin(angle)});
        }
        add({0, y, 0});
    }
    std::vector<glm::uvec3> triangles;
    const std::uint32_t top = around + 1;
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        triangles.emplace_back(around, i, next);
        triangles.emplace_back(top + around, top + next, top + i);
        triangles.emplace_back(i, top + i, next);
        triangles.emplace_back(next, top + i, top + next);
    }
    add_mesh(scene, star ? "star" : "prism", positions, triangles);
}

void add_soup(Scene& scene, Dice& dice, bool lattice) {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    const std::size_t vertices = 6 + dice.below(10);
    for (std::size_t i = 0; i < vertices; ++i) {
        const glm::dvec3 place = anywhere(dice, 3);
        positions.push_back(lattice ? on_lattice(place) : glm::vec3(place));
    }
    for (std::size_t left = 4 + dice.below(14); left > 0; --left) {
        const auto corner = [&] { return static_cast<std::uint32_t>(dice.below(vertices)); };
        triangles.emplace_back(corner(), corner(), corner());
    }
    add_mesh(scene, "soup", positions, triangles);
}

/// Up to 8 km wide.
void add_floor(Scene& scene, Dice& dice) {
    const auto half = static_cast<float>(dice.one_in(3) ? 4000 : 10);
    const float y = dice.one_in(3) ? -3.0F : static_cast<float>(dice.between(-4, -2));
    add_rectangle(scene, {-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half});
}

glm::dvec3 vertex(const Scene& scene, Dice& dice) {
    return glm::dvec3(scene.positions[dice.below(scene.positions.size())]);
}

/// A place, and in words which.
struct Place {
    glm::dvec3 at;
    std::string words;
};

/// Anywhere, inside some body, on a vertex, on an edge or a face, or an ulp from there.
Place odd_place(const Scene& scene, Dice& dice, double reach, bool on_casters) {
    const glm::uvec3& corners = scene.triangles[dice.below(scene.triangles.size())];
    const auto corner = [&](int k) { return glm::dvec3(scene.positions[corners[k]]); };
    const std::size_t chosen = dice.below(8);
    switch (chosen == 0 || on_casters ? chosen : 7) {
    case 0:
        return {0.5 * (vertex(scene, dice) + vertex(scene, dice)), "between two vertices"};
    case 1:
        return {vertex(scene, dice), "on a vertex"};
    case 2: {
        glm::dvec3 at = vertex(scene, dice);
        const int axis = static_cast<int>(dice.below(3));
        at[axis] = static_cast<double>(std::nextafter(static_cast<float>(at[axis]), 9.0F));
        return {at, "an ulp from a vertex"};
    }
    case 3:
        return {0.5 * (corner(0) + corner(1)), "on an edge"};
    case 4:
        return {0.25 * corner(0) + 0.25 * corner(1) + 0.5 * corner(2), "on a face"};
    default:
        return {anywhere(dice, reach), "anywhere"};
    }
}

std::string add_light(Scene& scene, Dice& dice) {
    Light& light = scene.lights.front();
    if (dice.one_in(4)) {
        light.kind = Light::Kind::directional;
        light.direction = glm::normalize(anywhere(dice, 1));
        if (!dice.one_in(2)) return "a sun";
        // Straight down by the usual quaternion: 2e-16 of it points sideways.
        const double half = std::sqrt(0.5);
        light.direction = glm::dquat(half, -half, 0, 0) * glm::dvec3(0, 0, -1);
        return "a sun at noon";
    }
    const Place place = odd_place(scene, dice, 6, true);
    light.position = place.at;
    if (!dice.one_in(5)) return "a lamp " + place.words;
    light.kind = Light::Kind::spot;
    light.direction = glm::normalize(anywhere(dice, 1));
    light.outer_cone = dice.between(0.2, 1.5);
    return "a spot " + place.words;
}

std::string set_camera(Scene& scene, Dice& dice, const Oddities& oddities) {
    Camera& camera = scene.camera;
    camera.width = 24 * oddities.scale;
    camera.height = 20 * oddities.scale;
    const Place eye = odd_place(scene, dice, 6, oddities.eyes_on_casters);
    if (dice.one_in(4)) { // level, as a sun at noon is hard on it
        camera.eye = eye.at;
        camera.forward = {0, 0, -1};
        camera.right = {1, 0, 0};
        camera.up = {0, 1, 0};
    } else {
        look_at(camera, eye.at, anywhere(dice, 1) + glm::dvec3(0.01, 0, 0.02));
    }
    camera.half_height = dice.between(0.2, 1.5);
    camera.near = dice.one_in(3) ? dice.between(0.5, 3) : dice.between(0.01, 0.3);
    if (dice.one_in(2)) camera.far = camera.near + dice.between(2, 20);
    if (oddities.orthographic) {
        camera.projection = Projection::orthographic;
        camera.half_height = dice.between(0.2, 6);
        if (dice.one_in(3)) camera.near = 0;
        if (dice.one_in(4)) camera.eye -= dice.between(5, 50) * camera.forward;
    }
    return fmt::format("the eye {}, near {:.3g}, far {:.3g}", eye.words, camera.near, camera.far);
}

} // namespace

Scene random_scene(Dice& dice, const Oddities& oddities) {
    Scene scene = empty_scene();
    const bool lattice = dice.one_in(2);
    std::string bodies;
    for (std::size_t left = 1 + dice.below(3); left > 0; --left)
        dice.one_in(4) ? add_soup(scene, dice, lattice)
                       : add_body(scene, dice, lattice && oddities.bodies_on_quarters);
    for (const Mesh& mesh : scene.meshes) bodies += mesh.name + ", ";
    if (dice.one_in(2)) scene.materials.front().double_sided = true;
    if (dice.one_in(2)) add_floor(scene, dice);
    const std::string light = add_light(scene, dice);
    const std::string_view on_quarters =
        oddities.bodies_on_quarters ? "all on quarters, " : "soups on quarters, ";
    scene.name = fmt::format("{}{}{}; {}", bodies, lattice ? on_quarters : "", light,
                             set_camera(scene, dice, oddities));
    return scene;
}

} // namespace shadowproof::tests
