#include "compare/picture/light_sampling.h"

#include "reference/trace/first_met.h"

#include <algorithm>
#include <bit>
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
    int face = 0; ///< of a cube: twice the axis, and one more on its negative side
    LightAxes axes;
    double side = 0;         ///< of a texel, in the units of place_from_light; 0: none to speak of
    glm::dvec2 corner{0, 0}; ///< where texel (0,0) begins, in texels from the middle
    glm::dvec2 place{0, 0};  ///< in texels from there; without texels in the units of the place
    int texels = 0;          ///< along a side; 0: any number
    glm::dvec2 across{0, 0}; ///< the point's own place on a cube's face
    double narrower = 1;     ///< of a cube: by which the face is asked as if it were smaller
};

/// In texels, of a place on a cube's face.
glm::dvec2 in_texels(const Lookup& at, const glm::dvec2& across) {
    return (at.narrower * across + 1.0) / 2.0 * static_cast<double>(at.texels);
}

Lookup lookup(const Light& light, const LightSampling& view, const glm::dvec3& point) {
    if (view.plane) {
        const TexelPlane& plane = *view.plane;
        const glm::dvec2 place(place_from_light(light, plane.axes, point));
        if (plane.side == 0) return {0, plane.axes, 0, {0, 0}, place, 0};
        return {0, plane.axes, plane.side, plane.corner, place / plane.side - plane.corner, 0};
    }
    if (light.kind == Light::Kind::directional)
        return {0,
                usual_axes(light).front(),
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
    const int face = 2 * axis + (way[axis] < 0 ? 1 : 0);
    if (view.texels == 0) return {face, axes, 0, {0, 0}, place, 0};
    const double narrower = 1 - static_cast<double>(view.inset) / view.texels;
    Lookup at{face,        axes,  2.0 / view.texels, glm::dvec2(-view.texels / 2.0), {},
              view.texels, place, narrower};
    at.place = in_texels(at, place);
    return at;
}

/// Calls visit(place) for each of MapFilter::Over::points.
template <class Visit>
void visit_points(const Lookup& at, const Visit& visit) {
    const bool is_cube = at.texels > 0;
    visit(at.place);
    if (!is_cube) {
        for (const double away : {0.5, 1.0})
            for (const int x : {-1, 0, 1})
                for (const int y : {-1, 0, 1})
                    if (x != 0 || y != 0) visit(at.place + away * glm::dvec2(x, y));
        return;
    }
    // Along all three axes of space, that of the face as well.
    const double away = std::hypot(at.across.x, at.across.y, 1.0) / (2.0 * at.texels);
    for (const int x : {-1, 1})
        for (const int y : {-1, 1})
            for (const int depth : {-1, 1})
                visit(in_texels(at, (at.across + away * glm::dvec2(x, y)) / (1 + away * depth)));
}

/// Calls visit(texel, weight) for each texel that is asked: its number along both sides, and its
/// part of the average. Where there are no texels to speak of, for the place itself.
template <class Visit>
void visit_asked(const Lookup& at, const MapFilter& filter, const Visit& visit) {
    if (at.side == 0) return visit(at.place, 1);
    const double last_texel = at.texels > 0 ? at.texels - 1.0 : infinity;
    const double first_texel = at.texels > 0 ? 0 : -infinity;
    const auto in_map = [&](const glm::dvec2& texel) {
        return glm::clamp(texel, first_texel, last_texel);
    };
    if (filter.width == 0) return visit(in_map(glm::floor(at.place)), 1);
    if (filter.over == MapFilter::Over::points)
        return visit_points(at,
                            [&](const glm::dvec2& place) { visit(in_map(glm::floor(place)), 1); });
    const bool is_square = filter.over == MapFilter::Over::square;
    const double width = filter.width;
    const glm::dvec2 low = is_square ? at.place - width / 2 : at.place - (width - 1) / 2;
    const glm::dvec2 first = glm::floor(low);
    const int count = is_square ? filter.width + 1 : filter.width;
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x) {
            const glm::dvec2 texel = first + glm::dvec2(x, y);
            const glm::dvec2 part = glm::min(texel + 1.0, low + width) - glm::max(texel, low);
            const double weight = is_square ? std::max(part.x, 0.0) * std::max(part.y, 0.0) : 1;
            if (weight > 0) visit(in_map(texel), weight);
        }
}

/// For one point, at most.
std::size_t most_asked(const MapFilter& filter) {
    if (filter.over == MapFilter::Over::points) return 17;
    const int side = filter.over == MapFilter::Over::square ? filter.width + 1 : filter.width;
    return static_cast<std::size_t>(std::max(side * side, 1));
}

/// A texel that some lookup asks.
struct Texel {
    std::size_t lookup = 0; ///< the number of the first one that does
    glm::dvec2 number{0, 0};
    glm::dvec2 middle{0, 0}; ///< in the units of place_from_light
};

/// The texels that lookups ask. Those beside each other ask the same ones, which are remembered,
/// most of them.
class Texels {
public:
    std::size_t find_or_add(std::span<const Lookup> lookups, std::size_t lookup,
                            const glm::dvec2& number) {
        const Lookup& at = lookups[lookup];
        if (at.side == 0) return add({lookup, number, number});
        const auto is_it = [&](const Texel& other) {
            return other.number == number && lookups[other.lookup].face == at.face;
        };
        std::size_t& remembered = remembered_[hash(number)];
        if (remembered == none || !is_it(all[remembered]))
            remembered = add({lookup, number, at.side * (number + 0.5 + at.corner)});
        return remembered;
    }

    std::vector<Texel> all;

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    static constexpr int bits = 14; // of what is remembered: more is slower to look at
    std::vector<std::size_t> remembered_ = std::vector<std::size_t>(std::size_t{1} << bits, none);

    /// The top bits of a product, which depend on all bits of both numbers.
    static std::size_t hash(const glm::dvec2& number) {
        constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
        return ((std::bit_cast<std::uint64_t>(number.x) * odd +
                 std::bit_cast<std::uint64_t>(number.y)) *
                odd) >>
               (64 - bits);
    }
    std::size_t add(const Texel& texel) {
        all.push_back(texel);
        return all.size() - 1;
    }
};

/// Of depth 1.
glm::dvec3 direction_of(const Lookup& at, const glm::dvec2& middle) {
    return at.axes.forward + middle.x * at.axes.right + middle.y * at.axes.up;
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

/// What the light sees through texels. Depths of a directional light are from the origin.
std::vector<SeenSurface> seen_through(const Tracer& light_tracer, std::span<const Lookup> lookups,
                                      std::span<const Texel> texels) {
    const Scene& from_light = light_tracer.scene();
    const Light& light = chosen_light(from_light);
    if (light.kind != Light::Kind::directional) {
        std::vector<glm::dvec3> directions;
        directions.reserve(texels.size());
        for (const Texel& texel : texels)
            directions.push_back(direction_of(lookups[texel.lookup], texel.middle));
        return see_rays(light_tracer, directions);
    }
    std::vector<AnyRay> rays;
    rays.reserve(texels.size());
    for (const Texel& texel : texels) {
        const LightAxes& axes = lookups[texel.lookup].axes;
        rays.push_back({texel.middle.x * axes.right + texel.middle.y * axes.up, light.direction,
                        -infinity, infinity});
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
                    const Lookup& at, const Texel& texel, const SeenSurface& seen) {
    const Light& light = chosen_light(from_light);
    const bool directional = light.kind == Light::Kind::directional;
    LightSample sample;
    const glm::dvec3 way = directional ? point : point - light.position;
    sample.own_depth = glm::dot(way, at.axes.forward);
    if (!directional) {
        sample.own_stretch = glm::length(way) / sample.own_depth;
        sample.seen_stretch = glm::length(direction_of(at, texel.middle));
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

std::vector<LightSample> sample_light(const Tracer& light_tracer, const LightSampling& view,
                                      std::span<const glm::dvec3> points) {
    const Scene& from_light = light_tracer.scene();
    const Light& light = chosen_light(from_light);
    struct Asked {
        std::size_t texel = 0;
        double weight = 1;
    };
    std::vector<Lookup> lookups;
    lookups.reserve(points.size());
    for (const glm::dvec3& point : points) lookups.push_back(lookup(light, view, point));
    Texels texels;
    std::vector<Asked> asked;
    std::vector<std::size_t> end_of; // of a lookup's among those asked
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        visit_asked(lookups[i], view.filter, [&](const glm::dvec2& number, double weight) {
            asked.push_back({texels.find_or_add(lookups, i, number), weight});
        });
        // Where a place has no parts of texels, none has a weight.
        if (asked.size() == (i == 0 ? 0 : end_of.back()))
            asked.push_back({texels.find_or_add(lookups, i, glm::floor(lookups[i].place)), 1});
        end_of.push_back(asked.size());
    }
    const std::vector<SeenSurface> seen = seen_through(light_tracer, lookups, texels.all);
    std::vector<LightSample> samples;
    samples.reserve(points.size());
    std::vector<WeightedSample> block;
    auto next = asked.begin();
    for (std::size_t i = 0; i < points.size(); ++i) {
        block.clear();
        for (; next != asked.begin() + static_cast<std::ptrdiff_t>(end_of[i]); ++next)
            block.push_back({sampled(from_light, view, points[i], lookups[i],
                                     texels.all[next->texel], seen[next->texel]),
                             next->weight});
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
        const std::size_t at_once =
            std::max<std::size_t>(128 / most_asked(view.filter), 1); // some megabytes of rays
        for (std::size_t first = 0; first < patches.size(); first += at_once) {
            const auto part = patches.subspan(first, std::min(at_once, patches.size() - first));
            std::vector<glm::dvec3> points;
            for_each_lightable(traced, part,
                               [&](int x, int y) { points.push_back(seen_point(traced, x, y)); });
            const std::vector<LightSample> samples = sample_light(tracer, view, points);
            for (const Patch& patch : part)
                for_each_pixel(patch, [&](int x, int y) {
                    if (faces_light(traced, picture.index(x, y)))
                        picture.at(x, y) = Visibility::shadowed;
                });
            auto next = samples.begin();
            for_each_lightable(traced, part, [&](int x, int y) {
                if ((next++)->excess(bias, directional) <= bias.constant)
                    picture.at(x, y) = Visibility::lit;
            });
        }
    };
}

} // namespace shadowproof
