#include "tests/raster/small_scenes.h"

#include <array>
#include <glm/geometric.hpp>
#include <span>
#include <string>

namespace shadowproof::tests {

namespace {

void add_mesh(Scene& scene, std::span<const glm::vec3> positions,
              std::span<const glm::uvec3> triangles) {
    const auto first_position = static_cast<std::uint32_t>(scene.positions.size());
    const auto first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
    scene.positions.insert(scene.positions.end(), positions.begin(), positions.end());
    for (const glm::uvec3& triangle : triangles)
        scene.triangles.push_back(triangle + first_position);
    scene.meshes.push_back({.name = "mesh " + std::to_string(scene.meshes.size()),
                            .first_triangle = first_triangle,
                            .triangle_count = static_cast<std::uint32_t>(triangles.size()),
                            .material = static_cast<std::uint32_t>(scene.materials.size() - 1)});
}

} // namespace

Scene empty_scene() {
    Scene scene;
    scene.name = "small";
    scene.materials.push_back({.name = "single-sided", .double_sided = false});
    scene.lights.push_back({.name = "light", .position = {0, 0, 5}});
    scene.camera.eye = {0, 0, 5};
    scene.camera.width = 64;
    scene.camera.height = 64;
    return scene;
}

void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& high) {
    std::array<glm::vec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                      (i & 4U) != 0 ? high.z : low.z};
    constexpr std::array<glm::uvec3, 12> faces{{{0, 4, 6},
                                                {0, 6, 2},
                                                {1, 3, 7},
                                                {1, 7, 5},
                                                {0, 1, 5},
                                                {0, 5, 4},
                                                {2, 6, 7},
                                                {2, 7, 3},
                                                {0, 2, 3},
                                                {0, 3, 1},
                                                {4, 5, 7},
                                                {4, 7, 6}}};
    add_mesh(scene, corners, faces);
}

void add_rectangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                   const glm::vec3& d) {
    add_mesh(scene, std::array{a, b, c, d}, std::array{glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)});
}

void look_at(Camera& camera, const glm::dvec3& eye, const glm::dvec3& target) {
    camera.eye = eye;
    camera.forward = glm::normalize(target - eye);
    camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0, 1, 0)));
    camera.up = glm::cross(camera.right, camera.forward);
}

Scene box_over_floor() {
    Scene scene = empty_scene();
    add_box(scene, {-1, 1, -1}, {1, 2, 1});
    scene.materials.push_back({.name = "double-sided", .double_sided = true});
    add_rectangle(scene, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}, {-10, 0, -10});
    scene.lights[0].position = {0, 6, 0};
    look_at(scene.camera, {4, 6, 7}, {0, 0, 0});
    scene.camera.width = 128;
    scene.camera.height = 128;
    return scene;
}

Pixel pixel_of(const Scene& scene, const glm::dvec3& point) {
    const glm::dvec2 picture = project(scene.camera, point);
    return {static_cast<int>(picture.x), static_cast<int>(picture.y)};
}

} // namespace shadowproof::tests
