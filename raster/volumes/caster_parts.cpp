#include "raster/volumes/caster_parts.h"

#include "scenes/mesh/counted_casters.h"

#include <algorithm>
#include <utility>

namespace shadowproof {

std::vector<CasterPart> caster_parts(const Scene& scene, const Counting& counting,
                                     const std::vector<std::uint8_t>& flipped, bool flipped_apart) {
    Scene casters = counted_casters(scene, counting, flipped);
    const std::vector<std::uint8_t> casts = casting_triangles(casters);
    const std::vector<glm::uvec3> triangles = std::exchange(casters.triangles, {});
    casters.meshes.clear();
    std::vector<CasterPart> parts;
    if (counting.casters.empty()) parts.push_back({counting.caster(0), casters, {}, false});
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const Counting::Caster caster = counting.caster(triangle);
        const bool is_flipped =
            flipped_apart && triangle < flipped.size() && flipped[triangle] != 0;
        auto part = std::find_if(parts.begin(), parts.end(), [&](const CasterPart& p) {
            return p.caster == caster && p.flipped == is_flipped;
        });
        if (part == parts.end())
            part = parts.insert(parts.end(), {caster, casters, {}, is_flipped});
        part->scene.triangles.push_back(triangles[triangle]);
        part->triangles.push_back(triangle);
    }
    return parts;
}

} // namespace shadowproof
