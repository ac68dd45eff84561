#include "compare/picture/fitted_bias.h"
#include "compare/picture/hypotheses.h"
#include "compare/picture/map_ends.h"
#include "compare/picture/texel_planes.h"
#include "reference/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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
                                const LightSampling& view, const MapBias& like = {}) {
    const auto bias =
        fitted_bias(trial, sample_light(from_light, view, trial.sampled_points()), like);
    if (!bias) return std::nullopt;
    return FittedMap{view, *bias};
}

/// The texels moved, and made wider or narrower about the picture's middle, as long as that
/// explains more: borders that steps tell to a part of a pixel are told by all pixels together.
void climb(const Trial& trial, const Tracer& from_light, FittedMap& best) {
    constexpr int rounds = 10;
    if (best.view.plane->is_exact) return;
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

/// Whether what is averaged is as wide as a pixel; narrower, it changes nothing that is seen.
bool is_visible(const LightSampling& view, double pixel_width) {
    return view.filter.width * view.plane->side >= pixel_width;
}

/// The best bias and filter of a map whose texels are known. `pixel_width`: between the places
/// of neighbouring pixels.
void settle_bias(const Trial& trial, const Tracer& from_light, double pixel_width, FittedMap& map) {
    const auto look = [&](const LightSampling& view, std::int64_t least) {
        const auto bias =
            fitted_bias(trial, sample_light(from_light, view, trial.sampled_points()));
        if (bias && bias->score >= least) map = {view, *bias};
    };
    look(map.view, map.fitted.score + least_gain);
    for (const LightSampling& softer : with_filters(trial, map.view))
        if (is_visible(softer, pixel_width)) look(softer, map.fitted.score + least_gain);
    if (!map.view.frustum) return;
    LightSampling endless = map.view; // texels may look as if shadows ended
    endless.frustum.reset();
    look(endless, map.fitted.score - static_cast<std::int64_t>(trial.sampled_wrong() / 20));
}

using Culled = LightSampling::Culled;

/// Calls work(i, tracer) for each of `count` views, side by side, with a tracer of what the light
/// sees without the sides that culled_of(i) leaves out. One such scene at a time is in memory.
template <class CulledOf, class Work>
void for_each_view(const Trial& trial, std::size_t count, const CulledOf& culled_of,
                   const Work& work) {
    for (const Culled culled : {Culled::none, Culled::front, Culled::back}) {
        std::vector<std::size_t> some;
        for (std::size_t i = 0; i < count; ++i)
            if (culled_of(i) == culled) some.push_back(i);
        if (some.empty()) continue;
        const Scene from_light = seen_from_light(trial.scene(), culled);
        if (from_light.triangles.empty()) return; // nothing casts
        const Tracer tracer(from_light, 1);
        parallel_for(static_cast<int>(some.size()), trial.traced().tracer().threads(),
                     [&](int each, int) { work(some[static_cast<std::size_t>(each)], tracer); });
    }
}

/// Adds each view with its best bias, where there is one. `like`: as of fitted_bias.
void add_fitted(const Trial& trial, std::span<const LightSampling> views, const MapBias& like,
                std::vector<FittedMap>& maps) {
    std::vector<std::optional<FittedMap>> tried(views.size());
    for_each_view(
        trial, views.size(), [&](std::size_t i) { return views[i].culled; },
        [&](std::size_t i, const Tracer& tracer) {
            tried[i] = fitted(trial, tracer, views[i], like);
        });
    for (const std::optional<FittedMap>& map : tried)
        if (map) maps.push_back(*map);
}

/// The filter that fits best on the sample's pictures, of those whose maps explain about as much:
/// scores leave out what is right next to the picture's outlines, fits what is next to those that
/// are predicted.
void settle_filter(Trial& trial, double pixel_width, FittedMap& map) {
    std::vector<LightSampling> views = with_filters(trial, map.view);
    std::erase_if(views, [&](const LightSampling& view) { return !is_visible(view, pixel_width); });
    std::vector<FittedMap> filtered;
    add_fitted(trial, views, {.of = map.fitted.bias.of, .slope = map.fitted.bias.slope}, filtered);
    const std::int64_t least =
        map.fitted.score - static_cast<std::int64_t>(trial.sampled_wrong() / 20);
    std::erase_if(filtered, [&](const FittedMap& each) { return each.fitted.score < least; });
    if (filtered.empty()) return;
    const auto fit = [&](const FittedMap& tried) {
        return trial.fit(lit_within(trial.traced(), tried.view, tried.fitted.bias)).score();
    };
    std::int64_t best = fit(map);
    for (const FittedMap& tried : filtered)
        if (const std::int64_t score = fit(tried); score > best) {
            map = tried;
            best = score;
        }
}

/// Whether a map as a renderer has it leaves next to nothing for others to explain.
bool explains_nearly_all(Trial& trial, const FittedMap& map) {
    if (!map.view.plane->is_exact) return false;
    const Fit fit = trial.fit(lit_within(trial.traced(), map.view, map.fitted.bias));
    return 10 * fit.explained >= 9 * trial.sampled_wrong() &&
           10 * fit.contradicted <= fit.explained;
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

/// Squares whose texels are tried: those that are usual, and those whose ends were found, last.
struct Squares {
    std::vector<MapSquare> all;
    std::size_t measured = 0; ///< how many of them

    /// Those that a map may have: where it shows where it ends, no other.
    std::span<const MapSquare> possible(const LightSampling& view) const {
        return std::span(all).last(view.frustum && measured > 0 ? measured : all.size());
    }
};

Squares squares_of(const Scene& scene, const std::optional<LightFrustum>& frustum) {
    Squares squares{usual_squares(scene)};
    if (!frustum) return squares;
    for (const MapSquare& square : measured_squares(*frustum, chosen_light(scene))) {
        squares.all.push_back(square);
        ++squares.measured;
    }
    return squares;
}

/// The picture's steps as each of a light's cameras sees them.
class StepsByAxes {
public:
    explicit StepsByAxes(const Trial& trial) : trial_(trial) {}

    const ShadowSteps& of(const LightAxes& axes) {
        for (const ShadowSteps& steps : known_)
            if (steps.axes.right == axes.right && steps.axes.up == axes.up) return steps;
        return known_.emplace_back(shadow_steps(trial_, axes));
    }

private:
    const Trial& trial_;
    std::deque<ShadowSteps> known_;
};

std::vector<TexelPlane> possible_planes(const Trial& trial, const std::vector<MapSquare>& squares,
                                        StepsByAxes& steps) {
    const Light& light = chosen_light(trial.scene());
    std::vector<TexelPlane> planes;
    for (const LightAxes& axes : usual_axes(light))
        for (const TexelPlane& plane : proposed_planes(steps.of(axes), light))
            planes.push_back(plane);
    for (const MapSquare& square : squares)
        for (int texels = smallest_map; texels <= largest_map; texels *= 2)
            planes.push_back(divided(steps.of(square.axes), square, texels));
    return planes;
}

/// How many texels a known square has along its side. Nothing where that is no power of two: texels
/// of any size divide some square into a whole number of them.
std::optional<int> across(const TexelPlane& plane, std::span<const MapSquare> squares) {
    constexpr double tolerance = 0.01; // two powers are a hundred times as far apart
    for (const MapSquare& square : squares)
        for (int texels = smallest_map; texels <= largest_map; texels *= 2)
            if (std::abs(plane.side * texels - square.side) <= tolerance * square.side)
                return texels;
    return std::nullopt;
}

bool explains_more(const FittedMap& a, const FittedMap& b) {
    return a.fitted.score > b.fitted.score;
}

/// `most` maps, the best first; of those whose planes are the same, the best alone.
template <class Same>
std::vector<FittedMap> best_of(std::vector<FittedMap> maps, std::size_t most, const Same& same) {
    std::stable_sort(maps.begin(), maps.end(), explains_more);
    std::vector<FittedMap> best;
    for (const FittedMap& map : maps) {
        const bool is_new = std::none_of(best.begin(), best.end(), [&](const FittedMap& other) {
            return same(*other.view.plane, *map.view.plane);
        });
        if (is_new && best.size() < most) best.push_back(map);
    }
    return best;
}

bool are_same_planes(const TexelPlane& a, const TexelPlane& b) {
    return a.axes.up == b.axes.up && a.side == b.side && a.corner == b.corner;
}

/// As near as climbing comes from one to the other.
bool have_same_sides(const TexelPlane& a, const TexelPlane& b) {
    constexpr double least_difference = 0.02;
    return std::abs(a.side - b.side) < least_difference * b.side;
}

/// The maps whose shadows may be soft, with filters: those that renderers have, each as it explains
/// most, and of others the best.
std::vector<LightSampling> softened(const Trial& trial, const std::vector<FittedMap>& maps,
                                    StepsByAxes& steps) {
    constexpr std::size_t most = 16;
    if (!trial.is_soft()) return {};
    std::vector<FittedMap> exact;
    std::vector<FittedMap> others;
    for (const FittedMap& map : maps) (map.view.plane->is_exact ? exact : others).push_back(map);
    std::vector<LightSampling> views;
    const std::size_t all = exact.size();
    for (const FittedMap& map : best_of(std::move(exact), all, are_same_planes)) {
        views.push_back(map.view);
        if (!map.view.frustum) continue;
        views.push_back(map.view); // soft shadows may look as if they ended
        views.back().frustum.reset();
    }
    for (const FittedMap& map : best_of(std::move(others), most, have_same_sides))
        views.push_back(map.view);
    views = filtered(trial, views);
    std::erase_if(views, [&](const LightSampling& view) {
        return !is_visible(view, steps.of(view.plane->axes).apart);
    });
    return views;
}

} // namespace

void try_plane_maps(Trial& trial) {
    constexpr std::size_t most_climbed = 4;
    if (chosen_light(trial.scene()).kind == Light::Kind::point) return;
    const std::optional<LightFrustum> frustum = fitted_frustum(trial);
    if (frustum) consider_ends(trial, *frustum);
    const Squares squares = squares_of(trial.scene(), frustum);
    StepsByAxes steps(trial);
    const std::vector<TexelPlane> planes = possible_planes(trial, squares.all, steps);
    std::vector<LightSampling> views;
    for (const Culled culled : {Culled::none, Culled::front, Culled::back})
        for (const TexelPlane& plane : planes)
            views.push_back({.culled = culled, .plane = plane, .frustum = frustum});
    std::vector<FittedMap> maps;
    add_fitted(trial, views, MapBias{}, maps);
    add_fitted(trial, softened(trial, maps, steps), MapBias{}, maps);
    if (maps.empty()) return;
    std::vector<FittedMap> climbed = best_of(std::move(maps), most_climbed, have_same_sides);
    std::vector<double> pixel_widths;
    for (const FittedMap& map : climbed)
        pixel_widths.push_back(steps.of(map.view.plane->axes).apart);
    settle_filter(trial, pixel_widths.front(), climbed.front());
    if (explains_nearly_all(trial, climbed.front())) climbed.resize(1);
    for_each_view(
        trial, climbed.size(), [&](std::size_t i) { return climbed[i].view.culled; },
        [&](std::size_t i, const Tracer& tracer) {
            climb(trial, tracer, climbed[i]);
            settle_bias(trial, tracer, pixel_widths[i], climbed[i]);
        });
    FittedMap& best = *std::min_element(climbed.begin(), climbed.end(), explains_more);
    settle_filter(trial, steps.of(best.view.plane->axes).apart, best);
    consider_plane(trial, best, across(*best.view.plane, squares.possible(best.view)));
}

} // namespace shadowproof
