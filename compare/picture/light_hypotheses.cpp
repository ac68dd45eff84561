// What is seen from the light: shadow maps, which keep it texel by texel, and rays that start off
// the surface.
#include "compare/picture/hypotheses.h"
#include "scenes/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How a shadow map divides what the light sees. texels: along each side of a cube's faces; 0: as
/// finely as floats do.
struct LightView {
    int texels = 0;
    double range = infinity; ///< nothing is shadowed further from the light
};

/// Towards the middle of the texel that holds the direction, on a cube whose faces lie across the
/// axes: all cube maps are divided so, whichever way a face is turned.
glm::dvec3 through_texel(const glm::dvec3& direction, int texels) {
    if (texels == 0) return direction;
    const glm::dvec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    glm::dvec3 through = direction / size[axis];
    for (int k = 0; k < 3; ++k)
        if (k != axis) {
            const double texel = std::floor((through[k] + 1) / 2 * texels);
            through[k] = 2 * (std::min(texel, texels - 1.0) + 0.5) / texels - 1;
        }
    return size[axis] * through;
}

/// The scene as the light sees it: casters alone, from all sides.
Scene seen_from_light(const Scene& scene) {
    Scene casters = kept_by(scene, [&](std::uint32_t triangle) {
        return scene.meshes[mesh_of(scene, triangle)].casts;
    });
    for (Material& material : casters.materials) material.double_sided = true;
    casters.camera.eye = chosen_light(scene).position;
    // Of the way to the surface, which is what directions are: what is closer to the light than
    // floats tell from it touches the light.
    casters.camera.near = 0x1p-23;
    casters.camera.far = infinity;
    return casters;
}

/// For each pixel of the patches that faces the light, in order: how much further from the light it
/// is than what the light sees there. Minus infinity: the light sees nothing, or it is beyond the
/// range.
std::vector<double> excesses(const TracedScene& traced, const Tracer& light_tracer,
                             const LightView& view, std::span<const Patch> patches) {
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
            directions.push_back(through_texel(ways.back(), view.texels));
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

Predict lit_within(const TracedScene& traced, const LightView& view, double bias) {
    return [&traced, view, bias](std::span<const Patch> patches, Image<Visibility>& picture) {
        const Scene scene = seen_from_light(traced.scene());
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

/// A pixel of the sample, by what lights it.
struct Threshold {
    double excess = 0;
    std::int64_t gain = 0; ///< of the score, once the bias reaches it
};

/// The bias by which most is explained less what is contradicted: half way between the pixels that
/// it must light and those that it must not.
std::optional<double> best_bias(const Trial& trial, const std::vector<double>& excess) {
    std::vector<Threshold> thresholds;
    auto next = excess.begin();
    const auto width = static_cast<std::size_t>(trial.truth().depth.width);
    for (const Patch& patch : trial.sample())
        for_each_pixel(patch, [&](int x, int y) {
            const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            if (!faces_light(trial.traced(), i)) return;
            const double reached = *next++;
            if (!trial.is_wrong(x, y) && !trial.is_right(x, y)) return;
            const bool is_lit = trial.frame().claim.at(x, y) == Visibility::lit;
            thresholds.push_back({reached, is_lit ? 1 : -1});
        });
    std::sort(thresholds.begin(), thresholds.end(),
              [](const Threshold& a, const Threshold& b) { return a.excess < b.excess; });
    std::int64_t score = 0;
    std::int64_t best = std::numeric_limits<std::int64_t>::min();
    std::optional<double> bias;
    for (std::size_t i = 0; i + 1 < thresholds.size(); ++i) {
        score += thresholds[i].gain;
        const double middle = (thresholds[i].excess + thresholds[i + 1].excess) / 2;
        if (score <= best || !std::isfinite(middle)) continue;
        best = score;
        bias = middle;
    }
    return bias;
}

struct MapFit {
    LightView view;
    double bias = 0;
    Fit fit;
};

void consider_map(Trial& trial, const MapFit& map) {
    Parameters parameters{{"resolution", map.view.texels}, {"bias", map.bias}};
    std::string words = fmt::format("a shadow map, cube of {} texels a side, bias {:.3g}",
                                    map.view.texels, map.bias);
    if (map.view.range < infinity) {
        parameters.emplace_back("range", map.view.range);
        words += fmt::format(", range {:.4g}", map.view.range);
    }
    trial.consider("shadow_map", parameters, words, lit_within(trial.traced(), map.view, map.bias));
}

} // namespace

Predict lit_within_bias(const TracedScene& traced, double bias) {
    return lit_within(traced, {}, bias);
}

void try_range(Trial& trial) {
    const Scene& scene = trial.scene();
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return;
    const GroundTruth& truth = trial.truth();
    Image<double> distance(truth.depth.width, truth.depth.height);
    double nearest = infinity;
    double furthest = 0;
    for (int y = 0; y < distance.height; ++y)
        for (int x = 0; x < distance.width; ++x) {
            if (truth.triangle.at(x, y) == no_triangle) continue;
            const double d = glm::distance(seen_point(trial.traced(), x, y), light.position);
            distance.at(x, y) = d;
            nearest = std::min(nearest, d);
            furthest = std::max(furthest, d);
        }
    if (!(nearest > 0) || !(furthest > nearest)) return;
    const auto shared = std::make_shared<const Image<double>>(std::move(distance));
    trial.search(
        {.hypothesis = "shadow_map",
         .parameter = "range",
         .predict =
             [&](double range) {
                 return changed(trial.traced(),
                                [&truth, shared, range](std::size_t i, Visibility was) {
                                    const bool beyond = shared->pixels[i] > range;
                                    return beyond && in_cone(truth, i) ? Visibility::lit : was;
                                });
             },
         .words =
             [](double range) {
                 return fmt::format("a shadow map that reaches {:.4g} from the light", range);
             }},
        nearest, furthest);
}

void try_light_view(Trial& trial) {
    const Scene& scene = trial.scene();
    if (chosen_light(scene).kind != Light::Kind::point) return;
    const Scene from_light = seen_from_light(scene);
    if (from_light.triangles.empty()) return;
    const Tracer tracer(from_light, trial.traced().tracer().threads());
    double range = infinity;
    if (const Parameters* found = trial.best_of("shadow_map")) range = found->front().second;
    constexpr int smallest = 64; // texels: engines offer powers of two
    constexpr int largest = 8192;
    std::optional<MapFit> best;
    for (const double reach : {infinity, range}) {
        if (reach == range && range == infinity) continue;
        for (int texels = smallest; texels <= largest; texels *= 2) {
            const LightView view{texels, reach};
            const auto bias =
                best_bias(trial, excesses(trial.traced(), tracer, view, trial.sample()));
            if (!bias) continue;
            const Fit fit = trial.fit(lit_within(trial.traced(), view, *bias));
            if (!best || fit.score() > best->fit.score()) best = MapFit{view, *bias, fit};
        }
    }
    if (best) consider_map(trial, *best);
    const auto epsilon = best_bias(trial, excesses(trial.traced(), tracer, {}, trial.sample()));
    if (epsilon && *epsilon > 0)
        trial.consider("ray_epsilon", {{"epsilon", *epsilon}},
                       fmt::format("shadow rays miss what is closer than {:.3g}", *epsilon),
                       lit_within(trial.traced(), {}, *epsilon));
}

} // namespace shadowproof
