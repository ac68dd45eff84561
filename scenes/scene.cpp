#include "scenes/scene.h"

#include <algorithm>

namespace shadowproof {

std::uint32_t mesh_of(const Scene& scene, std::uint32_t triangle) {
    const auto after = std::upper_bound(
        scene.meshes.begin(), scene.meshes.end(), triangle,
        [](std::uint32_t value, const Mesh& mesh) { return value < mesh.first_triangle; });
    return static_cast<std::uint32_t>(after - scene.meshes.begin()) - 1;
}

std::vector<std::uint8_t> double_sided_triangles(const Scene& scene) {
    std::vector<std::uint8_t> flags(scene.triangles.size(), 0);
    for (const Mesh& mesh : scene.meshes)
        if (scene.materials[mesh.material].double_sided)
            std::fill_n(flags.begin() + mesh.first_triangle, mesh.triangle_count, std::uint8_t{1});
    return flags;
}

} // namespace shadowproof
