#include "compare/picture/light_sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Towards the middle of the texel that holds the direction, on a cube whose faces lie across the
/// axes: all cube maps are divided so, whichever way a face is turned.
glm::dvec3 through_texel(const glm::dvec3& direction, const LightSampling& view) {
    const int texels = view.texels;
    if (texels == 0) return direction;
    const double narrower = 1 - static_cast<double>(view.inset) / texels;
    const glm::dvec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    glm::dvec3 through = direction / size[axis];
    for (int k = 0; k < 3; ++k)
        if (k != axis) {
            const double texel = std::floor((narrower * through[k] + 1) / 2 * texels);
            through[k] = 2 * (std::min(texel, texels - 1.0) + 0.5) / texels - 1;
        }
    return size[axis] * through;
}

} // namespace

Scene seen_from_light(const Scene& scene, LightSampling::Culled culled) {
    Scene casters = kept_by(scene, [&](std::uint32_t triangle) {
        return scene.meshes[mesh_of(scene, triangle)].casts;
    });
    if (culled == LightSampling::Culled::none)
        for (Material& material : casters.materials) material.double_sided = true;
    if (culled == LightSampling::Culled::front) // turned over, their backs are what is seen
        for (glm::uvec3& triangle : casters.triangles) std::swap(triangle.y, triangle.z);
    casters.camera.eye = chosen_light(scene).position;
    // Of the way to the surface, which is what directions are: what is closer to the light than
    // floats tell from it touches the light.
    casters.camera.near = 0x1p-23;
    casters.camera.far = infinity;
    return casters;
}

std::vector<double> excesses(const TracedScene& traced, const Tracer& light_tracer,
                             const LightSampling& view, std::span<const Patch> patches) {
    const Scene& scene = traced.scene();
    const glm::dvec3 light = chosen_light(scene).position;
    std::vector<glm::dvec3> ways;
    std::vector<glm::dvec3> directions;
    const auto width = static_cast<std::size_t>(traced.truth().depth.width);
    for (const Patch& patch : patches)
        for_each_pixel(patch, [&](int x, int y) {
            const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            if (!faces_light(traced, i)) return;
            ways.push_back(seen_point(traced, x, y) - light);
            directions.push_back(through_texel(ways.back(), view));
        });
    const std::vector<SeenSurface> seen = see_rays(light_tracer, directions);
    std::vector<double> excess(ways.size(), -infinity);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const double distance = glm::length(ways[i]);
        if (seen[i].triangle != no_triangle && distance <= view.range)
            excess[i] = distance - seen[i].depth * glm::length(directions[i]);
    }
    return excess;
}

Predict lit_within(const TracedScene& traced, const LightSampling& view, double bias) {
    return [&traced, view, bias](std::span<const Patch> patches, Image<Visibility>& picture) {
        const Scene scene = seen_from_light(traced.scene(), view.culled);
        const Tracer tracer(scene, traced.tracer().threads());
        const auto width = static_cast<std::size_t>(picture.width);
        constexpr std::size_t at_once = 128; // some megabytes of rays
        for (std::size_t first = 0; first < patches.size(); first += at_once) {
            const auto part = patches.subspan(first, std::min(at_once, patches.size() - first));
            const std::vector<double> excess = excesses(traced, tracer, view, part);
            auto next = excess.begin();
            for (const Patch& patch : part)
                for_each_pixel(patch, [&](int x, int y) {
                    const std::size_t i =
                        static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                    if (!faces_light(traced, i)) return;
                    const bool lit = *next++ <= bias && in_cone(traced.truth(), i);
                    picture.at(x, y) = lit ? Visibility::lit : Visibility::shadowed;
                });
        }
    };
}

} // namespace shadowproof
