#include "scenes/load/common/default_floor.h"

#include "scenes/load/common/bounding_sphere.h"
#include "scenes/load/common/room.h"

#include <algorithm>

namespace shadowproof {

void add_default_floor(Scene& scene) {
    constexpr double most = 0x1p61; // of what admission.h admits, half
    if (is_room(scene)) return;
    const Sphere sphere = bounding_sphere(scene);
    double lowest = scene.positions.front().y;
    for (const glm::vec3& position : scene.positions)
        lowest = std::min(lowest, static_cast<double>(position.y));
    const double half = 4 * sphere.radius;
    const double height = lowest - sphere.radius / 100;
    const double reach =
        half + std::max({std::abs(sphere.centre.x), std::abs(sphere.centre.z), std::abs(height)});
    if (!(reach < most)) return;
    scene.notes.push_back("a floor is under the model, to show its shadow (--floor no leaves it "
                          "out)");
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::dvec2& corner :
         {glm::dvec2(-1, 1), glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)})
        scene.positions.emplace_back(sphere.centre.x + half * corner.x, height,
                                     sphere.centre.z + half * corner.y);
    if (has_masks(scene)) scene.mask_at.resize(scene.positions.size());
    if (!scene.normals.empty()) scene.normals.resize(scene.positions.size());
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangles.emplace_back(first, first + 2, first + 3);
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.emplace_back().name = "floor";
    scene.meshes.push_back({"floor", triangles, 2, material, false, true});
    if (is_bump_lit(scene))
        scene.surfaces.insert(scene.surfaces.end(), 6, Surface{.normal = {0, 1, 0}});
}

} // namespace shadowproof
