#include "raster/caster_parts.h"

#include "scenes/counted_casters.h"

#include <algorithm>
#include <utility>

namespace shadowproof {

std::vector<CasterPart> caster_parts(const Scene& scene, const Counting& counting) {
    Scene casters = counted_casters(scene, counting);
    const std::vector<std::uint8_t> casts = casting_triangles(casters);
    const std::vector<glm::uvec3> triangles = std::exchange(casters.triangles, {});
    casters.meshes.clear();
    std::vector<CasterPart> parts;
    if (counting.casters.empty()) parts.push_back({counting.caster(0), casters, {}});
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const Counting::Caster caster = counting.caster(triangle);
        auto part = std::find_if(parts.begin(), parts.end(),
                                 [&](const CasterPart& p) { return p.caster == caster; });
        if (part == parts.end()) part = parts.insert(parts.end(), {caster, casters, {}});
        part->scene.triangles.push_back(triangles[triangle]);
        part->triangles.push_back(triangle);
    }
    return parts;
}

} // namespace shadowproof
