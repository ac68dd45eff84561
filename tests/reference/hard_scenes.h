// Small scenes that are hard for floats: random ones, and ones whose rays, lights and planes
// coincide exactly.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace shadowproof {

struct HardScene {
    std::string name;
    std::function<Scene()> make;
};
inline std::ostream& operator<<(std::ostream& out, const HardScene& scene) {
    return out << scene.name;
}

std::vector<HardScene> hard_scenes();
/// The same scenes before an orthographic camera: lines of sight through vertices and edges, in
/// planes of faces and along rays of light among them. Of every other one the near plane is where
/// the eye is.
std::vector<HardScene> orthographic_scenes();

/// A camera at the origin looking down -z whose rays have dyadic components: with `size` a power
/// of two, the ray through pixel (x, y) is ((2x + 1) / size - 1, 1 - (2y + 1) / size, -1).
Scene empty_scene(int size);
void add_triangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
/// Twelve triangles, outward.
void add_box(Scene& scene, const glm::vec3& lower, const glm::vec3& upper);
/// Call when all triangles are there: one mesh over all.
void finish(Scene& scene, bool double_sided);

} // namespace shadowproof
