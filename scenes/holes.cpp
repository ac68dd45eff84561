#include "scenes/holes.h"

#include "scenes/half_edge.h"
#include "scenes/topology.h"

#include <numeric>

namespace shadowproof {

Scene with_holes_filled(const Scene& scene) {
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::vector<glm::uvec3> lids =
        fill_holes(connect(scene, weld_by_position(scene.positions), all));
    Scene filled = scene;
    if (lids.empty()) return filled;
    filled.meshes.push_back({.name = "filled holes",
                             .first_triangle = static_cast<std::uint32_t>(all.size()),
                             .triangle_count = static_cast<std::uint32_t>(lids.size())});
    filled.triangles.insert(filled.triangles.end(), lids.begin(), lids.end());
    return filled;
}

} // namespace shadowproof
