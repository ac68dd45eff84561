#include "scenes/mesh/holes.h"

#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/topology.h"

namespace shadowproof {

Scene with_holes_filled(const Scene& scene) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    std::vector<std::uint32_t> casters;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        if (casts[triangle] != 0) casters.push_back(triangle);
    const std::vector<glm::uvec3> lids =
        fill_holes(connect(scene, weld_by_position(scene.positions), casters));
    Scene filled = scene;
    if (lids.empty()) return filled;
    filled.meshes.push_back({.name = "filled holes",
                             .first_triangle = static_cast<std::uint32_t>(scene.triangles.size()),
                             .triangle_count = static_cast<std::uint32_t>(lids.size())});
    filled.triangles.insert(filled.triangles.end(), lids.begin(), lids.end());
    return filled;
}

} // namespace shadowproof
