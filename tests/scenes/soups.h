// Small scenes of one mesh whose edges can be counted by hand.
#pragma once

#include "scenes/scene.h"

#include <numeric>
#include <utility>
#include <vector>

namespace shadowproof::test {

inline Scene soup(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles) {
    Scene scene;
    scene.positions = std::move(positions);
    scene.triangles = std::move(triangles);
    scene.meshes = {{"soup", 0, static_cast<std::uint32_t>(scene.triangles.size()), 0}};
    scene.materials = {{"plain", false}};
    scene.lights.emplace_back();
    return scene;
}

/// Adds triangles over the same positions as another mesh.
inline void add_mesh(Scene& scene, const char* name, const std::vector<glm::uvec3>& triangles) {
    scene.meshes.push_back({name, static_cast<std::uint32_t>(scene.triangles.size()),
                            static_cast<std::uint32_t>(triangles.size()), 0});
    scene.triangles.insert(scene.triangles.end(), triangles.begin(), triangles.end());
}

/// Corner i at (i & 1, i >> 1 & 1, i >> 2); the last two triangles are the top, z = 1.
inline Scene cube() {
    std::vector<glm::vec3> corners;
    for (unsigned i = 0; i < 8; ++i) corners.emplace_back(i & 1U, i >> 1U & 1U, i >> 2U);
    return soup(corners, {{0, 2, 3},
                          {0, 3, 1},
                          {0, 1, 5},
                          {0, 5, 4},
                          {1, 3, 7},
                          {1, 7, 5},
                          {3, 2, 6},
                          {3, 6, 7},
                          {2, 0, 4},
                          {2, 4, 6},
                          {4, 5, 7},
                          {4, 7, 6}});
}

inline std::vector<std::uint32_t> all_triangles(const Scene& scene) {
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

/// Drops triangles from the end of a scene of one mesh.
inline void keep_triangles(Scene& scene, std::uint32_t count) {
    scene.triangles.resize(count);
    scene.meshes[0].triangle_count = count;
}

} // namespace shadowproof::test
