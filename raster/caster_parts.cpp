#include "raster/caster_parts.h"

#include "scenes/holes.h"

#include <algorithm>
#include <utility>

namespace shadowproof {

std::vector<CasterPart> caster_parts(const Scene& scene, const Counting& counting) {
    Scene casters = counting.holes_filled ? with_holes_filled(scene) : scene;
    const std::vector<std::uint8_t> casts = casting_triangles(casters);
    const std::vector<glm::uvec3> triangles = std::exchange(casters.triangles, {});
    casters.meshes.clear();
    std::vector<CasterPart> parts;
    if (counting.casters.empty()) parts.push_back({counting.caster(0), casters});
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
        const Counting::Caster caster = counting.caster(triangle);
        if (casts[triangle] == 0 || caster.left_out) continue;
        auto part = std::find_if(parts.begin(), parts.end(),
                                 [&](const CasterPart& p) { return p.caster == caster; });
        if (part == parts.end()) part = parts.insert(parts.end(), {caster, casters});
        part->scene.triangles.push_back(triangles[triangle]);
    }
    return parts;
}

} // namespace shadowproof
