#include "reference/predict/flat_volume.h"

#include "scenes/mesh/touching_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// How near the light a far end counts as passing it. Where an edge of it passes at distance h,
/// with corners that are rounded to floats by e, the side that ends there lies in another plane
/// than light and edge, at an angle of e / h, and depths counted from the light are wrong in that
/// wedge. At 2^10 e the wedge is a thousandth, while the volume is no thicker than 2^-14 of its
/// size: less than the width of a pixel.
double near_light(const glm::dvec3& end) {
    return 0x1p-14 * glm::length(end);
}

} // namespace

std::vector<FlatVolume> flat_volumes(const Scene& casters, std::span<const glm::vec3> far_ends) {
    std::vector<FlatVolume> volumes;
    const glm::dvec4 light = homogeneous(chosen_light(casters));
    if (light.w == 0) return volumes;
    const std::vector<std::uint8_t> casts = casting_triangles(casters);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const glm::uvec3 corners = casters.triangles[triangle];
        std::array<glm::dvec3, 3> ends;
        double reach = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 end = far_ends[corners[k]];
            ends[static_cast<std::size_t>(k)] = end - glm::dvec3(light);
            reach = std::max(reach, near_light(end));
        }
        if (glm::length(nearest_to_origin(ends)) > reach) continue;
        FlatVolume volume{.triangle = triangle,
                          .faces_light = side(casters, triangle, light) > 0,
                          .corner = corner(casters, triangle, 0)};
        volume.normal = glm::normalize(glm::cross(corner(casters, triangle, 1) - volume.corner,
                                                  corner(casters, triangle, 2) - volume.corner));
        for (const glm::dvec3& end : ends)
            volume.thickness = std::max(
                volume.thickness,
                std::abs(glm::dot(volume.normal, glm::dvec3(light) + end - volume.corner)));
        volumes.push_back(volume);
    }
    return volumes;
}

Scene without(Scene casters, std::span<const FlatVolume> volumes) {
    for (const FlatVolume& volume : volumes) {
        glm::uvec3& corners = casters.triangles[volume.triangle];
        corners = glm::uvec3(corners.x);
    }
    return casters;
}

} // namespace shadowproof
