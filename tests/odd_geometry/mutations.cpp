#include "tests/odd_geometry/mutations.h"

#include "scenes/load/catalog.h"
#include "tests/raster/small_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace shadowproof::tests {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// What a coordinate may become.
const std::vector<float>& odd_floats() {
    static const std::vector<float> floats{
        0.0F, -0.0F, 0x1p-149F, 1e-40F, 0x1p-126F, 1e-30F, 1e-20F, 1e-10F,  1e-7F,    1.0F, 1e4F,
        1e7F, 1e10F, 1e15F,     1e18F,  0x1p62F,   1e20F,  1e30F,  3.4e38F, infinity, NAN};
    return floats;
}

float any_odd_float(Dice& dice) {
    // The last four are refused; ordinary mutations are to come through more often.
    const std::size_t count = odd_floats().size() - (dice.below(8) == 0 ? 0 : 4);
    const float size = odd_floats()[dice.below(count)];
    return dice.below(2) == 0 ? size : -size;
}

float step_by_an_ulp(float value, Dice& dice) {
    return std::nextafter(value, dice.below(2) == 0 ? infinity : -infinity);
}

glm::vec3& any_position(Scene& scene, Dice& dice) {
    return scene.positions[dice.below(scene.positions.size())];
}

std::string words(const glm::dvec3& v) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
}

std::string odd_coordinates(Scene& scene, Dice& dice) {
    const std::size_t vertex = dice.below(scene.positions.size());
    glm::vec3& position = scene.positions[vertex];
    const std::string before = words(position);
    const auto axes = static_cast<unsigned>(1 + dice.below(7)); // some of three, as bits
    for (int k = 0; k < 3; ++k)
        if ((axes >> static_cast<unsigned>(k) & 1U) != 0) position[k] = any_odd_float(dice);
    return fmt::format("vertex {} from {} to {}", vertex, before, words(position));
}

/// The same odd value for some coordinate of several vertices.
std::string one_odd_value_in_places(Scene& scene, Dice& dice) {
    const float value = any_odd_float(dice);
    const std::uint64_t count = 2 + dice.below(4);
    std::string said = fmt::format("{} at", value);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::size_t vertex = dice.below(scene.positions.size());
        const int axis = static_cast<int>(dice.below(3));
        scene.positions[vertex][axis] = value;
        said += fmt::format(" {}.{}", vertex, "xyz"[axis]);
    }
    return said;
}

std::string nudged_vertex(Scene& scene, Dice& dice) {
    const std::size_t vertex = dice.below(scene.positions.size());
    glm::vec3& position = scene.positions[vertex];
    for (int k = 0; k < 3; ++k)
        if (dice.below(2) == 0) position[k] = step_by_an_ulp(position[k], dice);
    return fmt::format("vertex {} by an ulp", vertex);
}

std::string vertex_onto_another(Scene& scene, Dice& dice) {
    const std::size_t vertex = dice.below(scene.positions.size());
    const std::size_t other = dice.below(scene.positions.size());
    scene.positions[vertex] = scene.positions[other];
    if (dice.below(2) == 0) return fmt::format("vertex {} onto {}", vertex, other);
    const int axis = static_cast<int>(dice.below(3));
    scene.positions[vertex][axis] += 1e-7F * std::max(1.0F, scene.positions[vertex][axis]);
    return fmt::format("vertex {} 1e-7 beside {}", vertex, other);
}

std::string swapped_vertices(Scene& scene, Dice& dice) {
    const std::size_t vertex = dice.below(scene.positions.size());
    const std::size_t other = dice.below(scene.positions.size());
    std::swap(scene.positions[vertex], scene.positions[other]);
    return fmt::format("vertices {} and {} swapped", vertex, other);
}

std::string odd_triangle(Scene& scene, Dice& dice) {
    const std::size_t number = dice.below(scene.triangles.size());
    glm::uvec3& triangle = scene.triangles[number];
    const std::size_t other = dice.below(scene.triangles.size());
    switch (dice.below(4)) {
    case 0:
        std::swap(triangle.x, triangle.y);
        return fmt::format("triangle {} flipped", number);
    case 1:
        triangle.z = triangle.x;
        return fmt::format("triangle {} collapsed", number);
    case 2:
        triangle = scene.triangles[other];
        return fmt::format("triangle {} doubles {}", number, other);
    default:
        triangle[static_cast<int>(dice.below(3))] = scene.triangles[other].x;
        return fmt::format("triangle {} has a corner of {}", number, other);
    }
}

std::string odd_place(const char* whose, glm::dvec3& place, Scene& scene, Dice& dice) {
    const glm::dvec3 vertex(any_position(scene, dice));
    switch (dice.below(5)) {
    case 0:
        place[static_cast<int>(dice.below(3))] = static_cast<double>(any_odd_float(dice));
        break;
    case 1:
        place = vertex;
        break;
    case 2:
        place = vertex;
        place.x = std::nextafter(place.x, 1e300);
        break;
    case 3:
        place[static_cast<int>(dice.below(3))] = vertex.x;
        break;
    default:
        place = 0.5 * (glm::dvec3(any_position(scene, dice)) + vertex);
        break;
    }
    return fmt::format("{} at {}", whose, words(place));
}

std::string odd_light(Scene& scene, Dice& dice) {
    Light& light = scene.lights[scene.light];
    if (light.kind != Light::Kind::directional)
        return odd_place("the light", light.position, scene, dice);
    light.direction[static_cast<int>(dice.below(3))] = 0;
    if (light.direction == glm::dvec3(0)) light.direction.y = -1;
    light.direction = glm::normalize(light.direction);
    return fmt::format("the light along {}", words(light.direction));
}

std::string other_scale(Scene& scene, Dice& dice) {
    static const std::vector<int> exponents{-35, -25, -20, -12, -7, 7, 12, 20, 25, 30};
    const int exponent = dice.one_of(exponents);
    const double factor = std::pow(10.0, exponent);
    for (glm::vec3& position : scene.positions) position = glm::dvec3(position) * factor;
    scene.camera.eye *= factor;
    scene.camera.near *= factor;
    scene.camera.far *= factor;
    for (Light& light : scene.lights) light.position *= factor;
    return fmt::format("the scene times 1e{}", exponent);
}

std::string odd_eye(Scene& scene, Dice& dice) {
    return odd_place("the eye", scene.camera.eye, scene, dice);
}

/// A triangular prism, closed, between two planes.
void add_prism(Scene& scene, float low, float high) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const float y : {low, high})
        for (const glm::vec2 at : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(0, 1)})
            scene.positions.emplace_back(at.x, y, at.y);
    const std::array<glm::uvec3, 8> faces{
        {{0, 1, 2}, {3, 5, 4}, {0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}, {2, 5, 0}, {0, 5, 3}}};
    scene.meshes.push_back({.name = "prism",
                            .first_triangle = static_cast<std::uint32_t>(scene.triangles.size()),
                            .triangle_count = static_cast<std::uint32_t>(faces.size())});
    for (const glm::uvec3& face : faces) scene.triangles.push_back(face + first);
}

Scene prism_under_the_sun() {
    Scene scene = prism_over_floor();
    scene.name = "prism under the sun";
    scene.lights[0].kind = Light::Kind::directional;
    scene.lights[0].direction = glm::normalize(glm::dvec3(0.25, -1, 0.5));
    return scene;
}

Scene named(const char* name, Scene scene) {
    scene.name = name;
    return scene;
}

} // namespace

Scene prism_over_floor() {
    Scene scene = empty_scene();
    scene.name = "prism over floor";
    add_prism(scene, 1, 2);
    scene.materials.push_back({.name = "double-sided", .double_sided = true});
    add_rectangle(scene, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}, {-10, 0, -10});
    scene.lights[0].position = {1, 6, 0.5};
    look_at(scene.camera, {4, 6, 7}, {0, 0, 0});
    scene.camera.width = 28;
    scene.camera.height = 24;
    return scene;
}

std::vector<Scene> scenes_to_mutate() {
    std::vector<Scene> scenes{named("box over floor", box_over_floor()), prism_over_floor(),
                              prism_under_the_sun()};
    for (const char* name : {"coarse_curve", "height_field", "overlapping", "sun", "spot"})
        scenes.push_back(load_scene(name, {}));
    for (Scene& scene : scenes) {
        scene.provokes.clear();
        scene.declares_provokes = false;
        scene.camera.width = 28;
        scene.camera.height = 24;
    }
    return scenes;
}

std::vector<std::string> mutate(Scene& scene, Dice& dice) {
    std::vector<std::string> said;
    for (std::uint64_t left = 1 + dice.below(3); left > 0; --left) switch (dice.below(12)) {
        case 0:
        case 1:
        case 2:
            said.push_back(odd_coordinates(scene, dice));
            break;
        case 3:
        case 4:
            said.push_back(one_odd_value_in_places(scene, dice));
            break;
        case 5:
            said.push_back(nudged_vertex(scene, dice));
            break;
        case 6:
            said.push_back(vertex_onto_another(scene, dice));
            break;
        case 7:
            said.push_back(swapped_vertices(scene, dice));
            break;
        case 8:
            said.push_back(odd_triangle(scene, dice));
            break;
        case 9:
            said.push_back(odd_light(scene, dice));
            break;
        case 10:
            said.push_back(odd_eye(scene, dice));
            break;
        default:
            said.push_back(other_scale(scene, dice));
            break;
        }
    return said;
}

bool is_finite(const Scene& scene) {
    const auto finite = [](const auto& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return std::ranges::all_of(scene.triangles,
                               [&](const glm::uvec3& triangle) {
                                   return finite(scene.positions[triangle.x]) &&
                                          finite(scene.positions[triangle.y]) &&
                                          finite(scene.positions[triangle.z]);
                               }) &&
           finite(scene.camera.eye) && std::isfinite(scene.camera.near) &&
           std::ranges::all_of(scene.lights,
                               [&](const Light& light) { return finite(light.position); });
}

} // namespace shadowproof::tests
