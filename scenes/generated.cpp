#include "scenes/generated.h"

#include <array>
#include <cmath>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double pi = std::numbers::pi;

/// A ball of 2 * rings * rings triangles, open at its poles by a tiny hole, with waves on it so
/// that it shadows itself. `waves`: their height, as a share of the radius.
void add_ball(Scene& scene, const glm::dvec3& centre, double radius, int rings, double waves) {
    const auto first = static_cast<glm::uint>(scene.positions.size());
    const int sectors = rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double theta = pi * (i + 0.01) / (rings + 0.02);
            const double phi = 2 * pi * j / sectors;
            const double r = radius * (1 + waves * std::sin(9 * theta) * std::cos(7 * phi));
            scene.positions.emplace_back(centre.x + r * std::sin(theta) * std::cos(phi),
                                         centre.y + r * std::cos(theta),
                                         centre.z + r * std::sin(theta) * std::sin(phi));
        }
    const auto at = [&](int i, int j) {
        return first + static_cast<glm::uint>(i * sectors + j % sectors);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            scene.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
            scene.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
        }
}

/// A smooth closed ball of 4 * rings * (rings - 1) triangles.
void add_smooth_ball(Scene& scene, const glm::dvec3& centre, double radius, int rings) {
    const auto first = static_cast<glm::uint>(scene.positions.size());
    const int sectors = 2 * rings;
    scene.positions.emplace_back(centre + glm::dvec3(0, radius, 0));
    scene.positions.emplace_back(centre - glm::dvec3(0, radius, 0));
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double theta = pi * i / rings;
            const double phi = 2 * pi * j / sectors;
            scene.positions.emplace_back(
                centre + radius * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                             std::sin(theta) * std::sin(phi)));
        }
    const auto at = [&](int i, int j) {
        if (i == 0 || i == rings) return first + (i == 0 ? 0U : 1U);
        return first + 2 + static_cast<glm::uint>((i - 1) * sectors + j % sectors);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) scene.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j));
            if (i < rings - 1)
                scene.triangles.emplace_back(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
}

void add_floor(Scene& scene) {
    const auto first = static_cast<glm::uint>(scene.positions.size());
    for (const auto& [x, z] : {std::pair{-8.F, -14.F}, {-8.F, 2.F}, {8.F, 2.F}, {8.F, -14.F}})
        scene.positions.emplace_back(x, -1.3F, z);
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangles.emplace_back(first, first + 2, first + 3);
}

/// A box from one corner to the opposite one, wound to be seen from outside.
void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<glm::uint>(scene.positions.size());
    for (int corner = 0; corner < 8; ++corner)
        scene.positions.emplace_back((corner & 1) != 0 ? high.x : low.x,
                                     (corner & 2) != 0 ? high.y : low.y,
                                     (corner & 4) != 0 ? high.z : low.z);
    constexpr std::array<std::array<glm::uint, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& [a, b, c, d] : faces) {
        scene.triangles.emplace_back(first + a, first + b, first + c);
        scene.triangles.emplace_back(first + a, first + c, first + d);
    }
}

/// All that was added so far is one mesh, seen from `eye` and lit from `light`.
void finish(Scene& scene, const char* mesh, const glm::dvec3& eye, const glm::dvec3& light) {
    scene.materials.emplace_back();
    scene.meshes = {{mesh, 0, static_cast<std::uint32_t>(scene.triangles.size()), 0}};
    scene.camera.eye = eye;
    scene.camera.half_height = 0.6;
    scene.lights.emplace_back();
    scene.lights[0].position = light;
}

Scene empty_scene(const char* name, int width, int height) {
    Scene scene;
    scene.name = name;
    scene.camera.width = width;
    scene.camera.height = height;
    return scene;
}

} // namespace

Scene dense_scene(int triangles, int width, int height) {
    Scene scene = empty_scene("dense", width, height);
    constexpr int balls = 5;
    const int rings = static_cast<int>(std::lround(std::sqrt(triangles / (2.0 * balls))));
    for (int i = 0; i < balls; ++i)
        add_ball(scene, {1.9 * (i - 2), 0.35 * (i % 3) - 0.2, -6 - 0.9 * (i % 2)}, 0.9, rings,
                 0.08);
    add_floor(scene);
    finish(scene, "balls", {0.137, 1.271, 1.093}, {3.1, 5.3, -2.7});
    return scene;
}

Scene stacked_scene(int plates, int width, int height) {
    Scene scene = empty_scene("stacked", width, height);
    for (int i = 0; i < plates; ++i) {
        const auto base = static_cast<float>(1.3 + 1.5 * i / plates);
        const auto top = static_cast<float>(1.3 + 1.5 * (i + 0.5) / plates);
        add_box(scene, {-1.2F, base, -6.2F}, {1.2F, top, -3.8F});
    }
    add_floor(scene);
    finish(scene, "plates", {0.137, 0.871, 1.093}, {0.31, 12.3, -4.9});
    return scene;
}

Scene parted_scene(int balls, int width, int height) {
    Scene scene = empty_scene("parted", width, height);
    const int columns = static_cast<int>(std::ceil(std::sqrt(balls)));
    const int rings = static_cast<int>(std::lround(128 / std::sqrt(balls)));
    const double room = 9.0 / columns; // for a ball, along each side of a square
    for (int i = 0; i < balls; ++i)
        add_smooth_ball(scene,
                        {room * (i % columns - 0.5 * (columns - 1)), 0.47 * room - 1.2,
                         1 - room * (i / columns + 0.5)},
                        0.4 * room, rings);
    add_floor(scene);
    finish(scene, "balls", {0.137, 1.271, 4.093}, {3.1, 12.3, -2.7});
    return scene;
}

Scene lit_scene(int lights, int width, int height) {
    Scene scene = dense_scene(10'000, width, height);
    scene.name = "lit";
    scene.lights.clear();
    for (int i = 0; i < lights; ++i) {
        const double angle = 2 * pi * i / lights + 0.3;
        Light light;
        light.position = {4.1 * std::cos(angle), 5.3, -6.5 + 4.1 * std::sin(angle)};
        scene.lights.push_back(light);
    }
    return scene;
}

} // namespace shadowproof
