#include "compare/picture/fitted_bias.h"
#include "compare/picture/hypotheses.h"
#include "compare/picture/map_ends.h"
#include "compare/picture/texel_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int smallest = 64; // texels: engines offer powers of two
constexpr int largest = 8192;

struct FittedMap {
    LightSampling view;
    FittedBias fitted;
};

/// The truth, but that it ends with the map.
Predict ended(const Trial& trial, const LightFrustum& frustum) {
    const TracedScene& traced = trial.traced();
    return changed(traced, [&traced, frustum](std::size_t i, Visibility was) {
        const auto width = static_cast<std::size_t>(traced.truth().depth.width);
        const glm::dvec3 point =
            seen_point(traced, static_cast<int>(i % width), static_cast<int>(i / width));
        const glm::dvec3 place =
            place_from_light(chosen_light(traced.scene()), frustum.axes, point);
        return in_cone(traced.truth(), i) && !frustum.holds(place) ? frustum.outside : was;
    });
}

/// x, y and z are as of place_from_light.
void add_frustum(MapWords& words, const LightFrustum& frustum) {
    constexpr std::array<std::array<const char*, 2>, 3> names{
        {{"left", "right"}, {"bottom", "top"}, {"near", "far"}}};
    for (int k = 0; k < 3; ++k)
        for (const int end : {0, 1}) {
            const double at = end == 0 ? frustum.low[k] : frustum.high[k];
            if (!std::isfinite(at)) continue;
            const char* name = names[static_cast<std::size_t>(k)][static_cast<std::size_t>(end)];
            words.parameters.emplace_back(name, at);
            words.text += fmt::format(", {} {:.4g}", name, at);
        }
    if (frustum.outside == Visibility::lit) return;
    words.parameters.emplace_back("dark_outside", 1);
    words.text += dark_beyond;
}

std::optional<FittedMap> fitted(const Trial& trial, const Tracer& from_light,
                                const LightSampling& view) {
    const auto bias = fitted_bias(
        trial, sample_light(trial.traced(), from_light, view, trial.sample()), MapBias{});
    if (!bias) return std::nullopt;
    return FittedMap{view, *bias};
}

/// The texels moved, and made wider or narrower about the picture's middle, as long as that
/// explains more: borders that steps tell to a part of a pixel are told by all pixels together.
void climb(const Trial& trial, const Tracer& from_light, FittedMap& best) {
    constexpr int rounds = 10;
    const Light& light = chosen_light(trial.scene());
    glm::dvec2 low(infinity);
    glm::dvec2 high(-infinity);
    for (const Patch& patch : trial.sample())
        for_each_pixel(patch, [&](int x, int y) {
            if (!trial.is_wrong(x, y)) return;
            const glm::dvec2 place(
                place_from_light(light, best.view.plane->axes, seen_point(trial.traced(), x, y)));
            low = glm::min(low, place);
            high = glm::max(high, place);
        });
    const glm::dvec2 middle = 0.5 * (low + high);
    const double half = 0.5 * std::max(high.x - low.x, high.y - low.y);
    if (!(half > 0 && half < infinity)) return;
    double step = 0.25; // texels, at the furthest wrong pixel where it is the side that changes
    for (int i = 0; i < rounds; ++i) {
        bool better = false;
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                LightSampling tried = best.view;
                tried.plane = axis == 2 ? widened(*tried.plane, middle, half, sign * step)
                                        : moved(*tried.plane, axis, sign * step);
                const auto found = fitted(trial, from_light, tried);
                if (!found || found->fitted.score <= best.fitted.score) continue;
                best = *found;
                better = true;
                break;
            }
        if (!better) step /= 2;
    }
}

/// The best bias and filter of a map whose texels are known.
void settle_bias(const Trial& trial, const Tracer& from_light, FittedMap& map) {
    const auto look = [&](const LightSampling& view) {
        const auto bias =
            fitted_bias(trial, sample_light(trial.traced(), from_light, view, trial.sample()));
        if (bias && bias->score >= map.fitted.score + least_gain) map = {view, *bias};
    };
    look(map.view);
    for (const LightSampling& filtered : with_filters(trial, map.view)) look(filtered);
}

void consider_plane(Trial& trial, const FittedMap& map, const std::optional<int>& resolution) {
    const Light& light = chosen_light(trial.scene());
    const bool directional = light.kind == Light::Kind::directional;
    MapWords words;
    words.text = directional ? "a shadow map in parallel" : "a shadow map of the spot";
    if (resolution) {
        words.parameters.emplace_back("resolution", *resolution);
        words.text += fmt::format(", {} texels a side", *resolution);
    }
    const double side = map.view.plane->side;
    words.parameters.emplace_back("texel", side);
    words.text += fmt::format(", each {:.4g} wide{}", side, directional ? "" : " at distance 1");
    add_bias(words, map.fitted.bias);
    add_culling(words, map.view.culled);
    add_filter(words, map.view.filter);
    if (map.view.frustum) add_frustum(words, *map.view.frustum);
    trial.consider("shadow_map", words.parameters, words.text,
                   lit_within(trial.traced(), map.view, map.fitted.bias));
}

void consider_ends(Trial& trial, const LightFrustum& frustum) {
    MapWords words;
    words.text = "a shadow map that ends";
    add_frustum(words, frustum);
    trial.consider("shadow_map", words.parameters, words.text, ended(trial, frustum));
}

/// Squares whose texels are tried: those that are usual, and those whose ends were found.
std::vector<MapSquare> squares_of(const Scene& scene, const std::optional<LightFrustum>& frustum) {
    std::vector<MapSquare> squares = usual_squares(scene);
    if (!frustum) return squares;
    for (const MapSquare& square : measured_squares(*frustum)) squares.push_back(square);
    return squares;
}

std::vector<TexelPlane> possible_planes(const Trial& trial, const std::vector<MapSquare>& squares) {
    const Light& light = chosen_light(trial.scene());
    std::vector<TexelPlane> planes;
    for (const LightAxes& axes : usual_axes(light))
        for (const TexelPlane& plane : proposed_planes(shadow_steps(trial, axes))) {
            planes.push_back(plane);
            if (light.kind != Light::Kind::spot) continue;
            planes.push_back(plane); // a map around the axis, of an even number of texels
            planes.back().corner = {0, 0};
        }
    for (const MapSquare& square : squares) {
        const ShadowSteps steps = shadow_steps(trial, square.axes);
        for (int texels = smallest; texels <= largest; texels *= 2)
            planes.push_back(divided(steps, square, texels));
    }
    return planes;
}

/// How many texels a known square has along its side. Nothing where that is no power of two: texels
/// of any size divide some square into a whole number of them.
std::optional<int> across(const TexelPlane& plane, const std::vector<MapSquare>& squares) {
    constexpr double tolerance = 0.01; // two powers are a hundred times as far apart
    for (const MapSquare& square : squares)
        for (int texels = smallest; texels <= largest; texels *= 2)
            if (std::abs(plane.side * texels - square.side) <= tolerance * square.side)
                return texels;
    return std::nullopt;
}

} // namespace

void try_plane_maps(Trial& trial) {
    using Culled = LightSampling::Culled;
    constexpr std::size_t most_climbed = 4;
    constexpr double least_difference = 0.02; // of sides, below which climbing finds the other
    if (chosen_light(trial.scene()).kind == Light::Kind::point) return;
    const std::optional<LightFrustum> frustum = fitted_frustum(trial);
    if (frustum) consider_ends(trial, *frustum);
    std::vector<FittedMap> maps;
    const std::vector<MapSquare> squares = squares_of(trial.scene(), frustum);
    const std::vector<TexelPlane> planes = possible_planes(trial, squares);
    for (const Culled culled : {Culled::none, Culled::front, Culled::back}) {
        const Scene from_light = seen_from_light(trial.scene(), culled);
        if (from_light.triangles.empty()) return;
        const Tracer tracer(from_light, trial.traced().tracer().threads());
        for (const TexelPlane& plane : planes)
            if (const auto found =
                    fitted(trial, tracer, {.culled = culled, .plane = plane, .frustum = frustum}))
                maps.push_back(*found);
    }
    if (maps.empty()) return;
    const auto by_score = [](const FittedMap& a, const FittedMap& b) {
        return a.fitted.score > b.fitted.score;
    };
    std::stable_sort(maps.begin(), maps.end(), by_score);
    std::vector<FittedMap> climbed; // of each side of texels the best
    for (const FittedMap& map : maps) {
        const double side = map.view.plane->side;
        const bool is_new =
            std::none_of(climbed.begin(), climbed.end(), [&](const FittedMap& other) {
                return std::abs(other.view.plane->side - side) < least_difference * side;
            });
        if (is_new && climbed.size() < most_climbed) climbed.push_back(map);
    }
    for (FittedMap& map : climbed) {
        const Scene from_light = seen_from_light(trial.scene(), map.view.culled);
        const Tracer tracer(from_light, trial.traced().tracer().threads());
        climb(trial, tracer, map);
        settle_bias(trial, tracer, map);
    }
    const FittedMap& best = *std::min_element(climbed.begin(), climbed.end(), by_score);
    consider_plane(trial, best, across(*best.view.plane, squares));
}

} // namespace shadowproof
