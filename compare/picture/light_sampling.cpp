#include "compare/picture/light_sampling.h"

#include "reference/trace/first_met.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The axis of a cube's face that a direction passes.
int major_axis(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

/// Where a point is looked up: on a plane of texels, or on a face of a cube, which lies across an
/// axis: all cube maps are divided so, whichever way a face is turned.
struct Lookup {
    LightAxes axes;
    double side = 0;         ///< of a texel, in the units of place_from_light; 0: none to speak of
    glm::dvec2 corner{0, 0}; ///< where texel (0,0) begins, in texels from the middle
    glm::dvec2 place{0, 0};  ///< in texels from there; without texels in the units of the place
    int texels = 0;          ///< along a side; 0: any number
};

Lookup lookup(const Light& light, const LightSampling& view, const glm::dvec3& point) {
    if (view.plane) {
        const TexelPlane& plane = *view.plane;
        const glm::dvec2 place(place_from_light(light, plane.axes, point));
        if (plane.side == 0) return {plane.axes, 0, {0, 0}, place, 0};
        return {plane.axes, plane.side, plane.corner, place / plane.side - plane.corner, 0};
    }
    if (light.kind == Light::Kind::directional)
        return {usual_axes(light).front(),
                0,
                {0, 0},
                glm::dvec2(place_from_light(light, usual_axes(light).front(), point)),
                0};
    const glm::dvec3 way = point - light.position;
    const int axis = major_axis(way);
    LightAxes axes{glm::dvec3(0), glm::dvec3(0), glm::dvec3(0)};
    axes.forward[axis] = way[axis] < 0 ? -1 : 1;
    axes.right[(axis + 1) % 3] = 1;
    axes.up[(axis + 2) % 3] = 1;
    const glm::dvec2 place(place_from_light(light, axes, point));
    if (view.texels == 0) return {axes, 0, {0, 0}, place, 0};
    const double narrower = 1 - static_cast<double>(view.inset) / view.texels;
    return {axes, 2.0 / view.texels, glm::dvec2(-view.texels / 2.0),
            (narrower * place + 1.0) / 2.0 * static_cast<double>(view.texels), view.texels};
}

/// A texel that is asked, and its part of the average.
struct Asked {
    glm::dvec2 middle{0, 0}; ///< in the units of place_from_light
    double weight = 1;
};

std::vector<Asked> asked(const Lookup& at, const MapFilter& filter) {
    if (at.side == 0) return {{at.place, 1}};
    const auto middle = [&](const glm::dvec2& texel) {
        const double last = at.texels > 0 ? at.texels - 1.0 : infinity;
        const double first = at.texels > 0 ? 0 : -infinity;
        return at.side * (glm::clamp(texel, first, last) + 0.5 + at.corner);
    };
    if (filter.width == 0) return {{middle(glm::floor(at.place)), 1}};
    const double width = filter.width;
    const glm::dvec2 low = filter.smooth ? at.place - width / 2 : at.place - (width - 1) / 2;
    const glm::dvec2 first = glm::floor(low);
    const int count = filter.smooth ? filter.width + 1 : filter.width;
    std::vector<Asked> all;
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x) {
            const glm::dvec2 texel = first + glm::dvec2(x, y);
            const glm::dvec2 part = glm::min(texel + 1.0, low + width) - glm::max(texel, low);
            const double weight = filter.smooth ? std::max(part.x, 0.0) * std::max(part.y, 0.0) : 1;
            if (weight > 0) all.push_back({middle(texel), weight});
        }
    return all;
}

/// Of depth 1.
glm::dvec3 direction_of(const Lookup& at, const Asked& texel) {
    return at.axes.forward + texel.middle.x * at.axes.right + texel.middle.y * at.axes.up;
}

/// Change over a texel of what is seen, on its own plane (LightSample::slope).
double slope_of(const Scene& from_light, const Lookup& at, std::uint32_t triangle,
                bool directional) {
    const glm::dvec3 a = corner(from_light, triangle, 0);
    const glm::dvec3 normal =
        glm::cross(corner(from_light, triangle, 1) - a, corner(from_light, triangle, 2) - a);
    const double across =
        std::max(std::abs(glm::dot(normal, at.axes.right)), std::abs(glm::dot(normal, at.axes.up)));
    const double along = directional ? glm::dot(normal, at.axes.forward)
                                     : glm::dot(normal, a - chosen_light(from_light).position);
    const double slope = at.side * across / std::abs(along);
    return std::isfinite(slope) ? slope : 0; // seen edge-on
}

/// Whether a side of a caster that the light sees is drawn.
bool is_drawn(const Scene& from_light, std::uint32_t triangle, const glm::dvec3& forward) {
    const Mesh& mesh = from_light.meshes[mesh_of(from_light, triangle)];
    if (from_light.materials[mesh.material].double_sided) return true;
    const glm::dvec3 a = corner(from_light, triangle, 0);
    const glm::dvec3 normal =
        glm::cross(corner(from_light, triangle, 1) - a, corner(from_light, triangle, 2) - a);
    return glm::dot(normal, forward) < 0;
}

/// What the light sees through texels, each of the lookup whose number stands beside it. Depths of
/// a directional light are from the origin.
std::vector<SeenSurface> seen_through(const Tracer& light_tracer, std::span<const Lookup> lookups,
                                      std::span<const Asked> texels,
                                      std::span<const std::size_t> lookup_of) {
    const Scene& from_light = light_tracer.scene();
    const Light& light = chosen_light(from_light);
    if (light.kind != Light::Kind::directional) {
        std::vector<glm::dvec3> directions;
        directions.reserve(texels.size());
        for (std::size_t i = 0; i < texels.size(); ++i)
            directions.push_back(direction_of(lookups[lookup_of[i]], texels[i]));
        return see_rays(light_tracer, directions);
    }
    std::vector<AnyRay> rays;
    rays.reserve(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const LightAxes& axes = lookups[lookup_of[i]].axes;
        rays.push_back({texels[i].middle.x * axes.right + texels[i].middle.y * axes.up,
                        light.direction, -infinity, infinity});
    }
    std::vector<SeenSurface> seen;
    seen.reserve(rays.size());
    for (const MetTriangle& met : first_met(light_tracer, rays, [&](std::uint32_t triangle) {
             return is_drawn(from_light, triangle, light.direction);
         }))
        seen.push_back({met.triangle, met.t});
    return seen;
}

LightSample sampled(const Scene& from_light, const LightSampling& view, const glm::dvec3& point,
                    const Lookup& at, const Asked& texel, const SeenSurface& seen) {
    const Light& light = chosen_light(from_light);
    const bool directional = light.kind == Light::Kind::directional;
    LightSample sample;
    const glm::dvec3 way = directional ? point : point - light.position;
    sample.own_depth = glm::dot(way, at.axes.forward);
    if (!directional) {
        sample.own_stretch = glm::length(way) / sample.own_depth;
        sample.seen_stretch = glm::length(direction_of(at, texel));
    }
    const bool is_beyond = !directional && reach_of(way, view.range_along_axes) > view.range;
    const bool is_outside =
        view.frustum && !view.frustum->holds(place_from_light(light, view.frustum->axes, point));
    if (is_beyond || is_outside) {
        const Visibility there = is_outside ? view.frustum->outside : view.beyond_range;
        sample.seen_depth = there == Visibility::lit ? infinity : -infinity;
        return sample;
    }
    if (seen.triangle == no_triangle) return sample;
    sample.seen_depth = seen.depth;
    sample.slope = slope_of(from_light, at, seen.triangle, directional);
    return sample;
}

struct WeightedSample {
    LightSample sample;
    double weight = 1;
};

/// The sample whose comparison decides, as that share of all must say `lit`: of one half, the
/// median.
LightSample deciding(std::vector<WeightedSample>& block, double share, bool directional) {
    const auto excess = [&](const WeightedSample& each) {
        return each.sample.excess(MapBias{}, directional);
    };
    std::sort(block.begin(), block.end(), [&](const WeightedSample& a, const WeightedSample& b) {
        return excess(a) < excess(b);
    });
    double all = 0;
    for (const WeightedSample& each : block) all += each.weight;
    double sum = 0;
    for (const WeightedSample& each : block) {
        sum += each.weight;
        if (sum >= share * all) return each.sample;
    }
    return block.back().sample;
}

} // namespace

glm::dvec3 place_from_light(const Light& light, const LightAxes& axes, const glm::dvec3& point) {
    const bool directional = light.kind == Light::Kind::directional;
    const glm::dvec3 way = directional ? point : point - light.position;
    const double depth = glm::dot(way, axes.forward);
    const double over = directional ? 1 : depth;
    return {glm::dot(way, axes.right) / over, glm::dot(way, axes.up) / over, depth};
}

std::vector<LightAxes> usual_axes(const Light& light) {
    constexpr double least = 0x1p-20; // of the sine between light and `up`
    std::vector<LightAxes> all;
    for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)}) {
        const glm::dvec3 across = glm::cross(light.direction, up);
        if (glm::length(across) < least) continue;
        const glm::dvec3 right = glm::normalize(across);
        all.push_back({right, glm::cross(right, light.direction), light.direction});
    }
    return all;
}

bool LightFrustum::holds(const glm::dvec3& place) const {
    return glm::all(glm::greaterThanEqual(place, low)) && glm::all(glm::lessThanEqual(place, high));
}

double LightSample::excess(const MapBias& bias, bool directional) const {
    if (std::isinf(seen_depth)) return -seen_depth;
    const double moved =
        bias.slope * slope *
        (directional || bias.of == BiasOf::inverse_depth ? 1 : seen_depth * seen_depth);
    switch (bias.of) {
    case BiasOf::depth:
        return own_depth - seen_depth - moved;
    case BiasOf::inverse_depth:
        return 1 / seen_depth - 1 / own_depth - moved;
    case BiasOf::distance:
        break;
    }
    return own_depth * own_stretch - seen_depth * seen_stretch - moved * seen_stretch;
}

Scene seen_from_light(const Scene& scene, LightSampling::Culled culled) {
    Scene casters = kept_by(scene, [&](std::uint32_t triangle) {
        return scene.meshes[mesh_of(scene, triangle)].casts;
    });
    if (culled == LightSampling::Culled::none)
        for (Material& material : casters.materials) material.double_sided = true;
    if (culled == LightSampling::Culled::front) // turned over, their backs are what is seen
        for (glm::uvec3& triangle : casters.triangles) std::swap(triangle.y, triangle.z);
    if (chosen_light(scene).kind == Light::Kind::directional) return casters;
    casters.camera.projection = Projection::perspective;
    casters.camera.eye = chosen_light(scene).position;
    // Of the way to the surface, which is what directions are: what is closer to the light than
    // floats tell from it touches the light.
    casters.camera.near = 0x1p-23;
    casters.camera.far = infinity;
    return casters;
}

std::vector<LightSample> sample_light(const TracedScene& traced, const Tracer& light_tracer,
                                      const LightSampling& view, std::span<const Patch> patches) {
    const Scene& from_light = light_tracer.scene();
    const Light& light = chosen_light(from_light);
    std::vector<glm::dvec3> points;
    const auto width = static_cast<std::size_t>(traced.truth().depth.width);
    for (const Patch& patch : patches)
        for_each_pixel(patch, [&](int x, int y) {
            const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            if (may_be_lit(traced, i)) points.push_back(seen_point(traced, x, y));
        });
    std::vector<Lookup> lookups;
    std::vector<Asked> texels;
    std::vector<std::size_t> lookup_of;
    lookups.reserve(points.size());
    for (const glm::dvec3& point : points) {
        lookups.push_back(lookup(light, view, point));
        for (const Asked& texel : asked(lookups.back(), view.filter)) {
            texels.push_back(texel);
            lookup_of.push_back(lookups.size() - 1);
        }
    }
    const std::vector<SeenSurface> seen = seen_through(light_tracer, lookups, texels, lookup_of);
    std::vector<LightSample> samples;
    samples.reserve(points.size());
    for (std::size_t i = 0; i < texels.size();) {
        const std::size_t point = lookup_of[i];
        std::vector<WeightedSample> block;
        for (; i < texels.size() && lookup_of[i] == point; ++i)
            block.push_back(
                {sampled(from_light, view, points[point], lookups[point], texels[i], seen[i]),
                 texels[i].weight});
        samples.push_back(block.size() == 1 ? block.front().sample
                                            : deciding(block, view.filter.lit_from,
                                                       light.kind == Light::Kind::directional));
    }
    return samples;
}

double reach_of(const glm::dvec3& way, bool along_axes) {
    if (!along_axes) return glm::length(way);
    return std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
}

Predict lit_within(const TracedScene& traced, const LightSampling& view, const MapBias& bias) {
    return [&traced, view, bias](std::span<const Patch> patches, Image<Visibility>& picture) {
        const Scene scene = seen_from_light(traced.scene(), view.culled);
        const Tracer tracer(scene, traced.tracer().threads());
        const bool directional = chosen_light(scene).kind == Light::Kind::directional;
        const auto width = static_cast<std::size_t>(picture.width);
        const std::size_t texels =
            view.filter.width > 0 ? static_cast<std::size_t>(view.filter.width * view.filter.width)
                                  : 1;
        const std::size_t at_once =
            std::max<std::size_t>(128 / texels, 1); // some megabytes of rays
        for (std::size_t first = 0; first < patches.size(); first += at_once) {
            const auto part = patches.subspan(first, std::min(at_once, patches.size() - first));
            const std::vector<LightSample> samples = sample_light(traced, tracer, view, part);
            auto next = samples.begin();
            for (const Patch& patch : part)
                for_each_pixel(patch, [&](int x, int y) {
                    const std::size_t i =
                        static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                    if (!faces_light(traced, i)) return;
                    const bool lit = may_be_lit(traced, i) &&
                                     (next++)->excess(bias, directional) <= bias.constant;
                    picture.at(x, y) = lit ? Visibility::lit : Visibility::shadowed;
                });
        }
    };
}

} // namespace shadowproof
