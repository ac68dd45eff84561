#include "compare/picture/fitted_bias.h"
#include "compare/picture/hypotheses.h"
#include "compare/picture/light_sampling.h"
#include "reference/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The name of the parameter that tells where a map ends.
const char* range_name(bool along_axes) {
    return along_axes ? "far" : "range";
}

void consider_cube(Trial& trial, const LightSampling& view, const MapBias& bias) {
    MapWords words;
    words.parameters = {{"resolution", view.texels}};
    words.text = fmt::format("a shadow map, cube of {} texels a side", view.texels);
    add_bias(words, bias);
    add_culling(words, view.culled);
    add_filter(words, view.filter);
    if (view.inset > 0) {
        words.parameters.emplace_back("inset", view.inset);
        words.text += ", whose faces are asked as if a texel narrower";
    }
    if (view.range < infinity) {
        const char* const name = range_name(view.range_along_axes);
        words.parameters.emplace_back(name, view.range);
        words.text += fmt::format(", {} {:.4g}", name, view.range);
        if (view.beyond_range == Visibility::shadowed) {
            words.parameters.emplace_back("dark_outside", 1);
            words.text += dark_beyond;
        }
    }
    trial.consider("shadow_map", words.parameters, words.text,
                   lit_within(trial.traced(), view, bias));
}

} // namespace

void add_bias(MapWords& words, const MapBias& bias) {
    words.parameters.emplace_back("bias", bias.constant);
    words.text += fmt::format(", bias {:.3g}", bias.constant);
    if (bias.of == BiasOf::depth) {
        words.parameters.emplace_back("depth", 1);
        words.text += " of depth";
    }
    if (bias.of == BiasOf::inverse_depth) {
        words.parameters.emplace_back("inverse_depth", 1);
        words.text += " of inverse depth";
    }
    if (bias.slope == 0) return;
    words.parameters.emplace_back("slope_bias", bias.slope);
    words.text += fmt::format(", slope bias {:.3g}", bias.slope);
}

void add_culling(MapWords& words, LightSampling::Culled culled) {
    if (culled == LightSampling::Culled::none) return;
    const bool front = culled == LightSampling::Culled::front;
    words.parameters.emplace_back(front ? "culls_front" : "culls_back", 1);
    words.text += front ? ", of back faces" : ", of front faces";
}

void add_filter(MapWords& words, const MapFilter& filter) {
    if (filter.width == 0) return;
    words.parameters.emplace_back("filter", filter.width);
    words.text += fmt::format(", over {} x {} texels", filter.width, filter.width);
    if (filter.over == MapFilter::Over::square) {
        words.parameters.emplace_back("smooth", 1);
        words.text += " smoothly";
    }
    if (filter.over == MapFilter::Over::points) {
        words.parameters.emplace_back("points", 1);
        words.text += " at single points";
    }
}

std::vector<LightSampling> filtered(const Trial& trial, std::span<const LightSampling> views) {
    using Over = MapFilter::Over;
    std::vector<LightSampling> all;
    if (!trial.is_soft()) return all;
    const double half = usual_lit_from.front();
    std::vector<MapFilter> filters{{1, Over::square, half}};
    for (const double lit_from : usual_lit_from) filters.push_back({3, Over::square, lit_from});
    for (const MapFilter& filter : filters)
        for (const LightSampling& view : views) {
            all.push_back(view);
            all.back().filter = filter;
        }
    return all;
}

std::vector<LightSampling> with_filters(const Trial& trial, const LightSampling& view) {
    std::vector<LightSampling> all;
    if (!trial.is_soft()) return all;
    for (const double lit_from : usual_lit_from)
        for (MapFilter filter : usual_filters) {
            filter.lit_from = lit_from;
            all.push_back(view);
            all.back().filter = filter;
        }
    return all;
}

namespace {

void try_range(Trial& trial, bool along_axes) {
    const Light& light = chosen_light(trial.scene());
    const GroundTruth& truth = trial.truth();
    Image<double> distance(truth.depth.width, truth.depth.height);
    double nearest = infinity;
    double furthest = 0;
    for (int y = 0; y < distance.height; ++y)
        for (int x = 0; x < distance.width; ++x) {
            if (truth.triangle.at(x, y) == no_triangle) continue;
            const double d =
                reach_of(seen_point(trial.traced(), x, y) - light.position, along_axes);
            distance.at(x, y) = d;
            nearest = std::min(nearest, d);
            furthest = std::max(furthest, d);
        }
    if (!(nearest > 0) || !(furthest > nearest)) return;
    const auto shared = std::make_shared<const Image<double>>(std::move(distance));
    for (const Visibility there : {Visibility::lit, Visibility::shadowed}) {
        const bool dark = there == Visibility::shadowed;
        trial.search(
            {.hypothesis = "shadow_map",
             .parameter = range_name(along_axes),
             .predict =
                 [&truth, &trial, shared, there](double range) {
                     return changed(trial.traced(),
                                    [&truth, shared, range, there](std::size_t i, Visibility was) {
                                        const bool beyond = shared->pixels[i] > range;
                                        return beyond && in_cone(truth, i) ? there : was;
                                    });
                 },
             .words =
                 [dark, along_axes](double range) {
                     return fmt::format("a shadow map{} {:.4g} {}{}",
                                        along_axes ? ", a cube whose faces reach" : " that reaches",
                                        range, along_axes ? "along their axes" : "from the light",
                                        dark ? dark_beyond : "");
                 },
             .also = dark ? Parameters{{"dark_outside", 1}} : Parameters{}},
            nearest, furthest);
    }
}

} // namespace

void try_range(Trial& trial) {
    const Light::Kind kind = chosen_light(trial.scene()).kind;
    if (kind == Light::Kind::directional) return;
    try_range(trial, false);
    if (kind == Light::Kind::point && !trial.is_settled()) try_range(trial, true);
}

namespace {

/// Rays that miss more see more light, and never less.
Predict with_epsilon(const TracedScene& traced, const MapBias& bias) {
    return [&traced, within = lit_within(traced, {}, bias)](std::span<const Patch> patches,
                                                            Image<Visibility>& picture) {
        within(patches, picture);
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) {
                if (const Visibility truth = traced.truth().visibility.at(x, y);
                    truth == Visibility::lit)
                    picture.at(x, y) = truth;
            });
    };
}

} // namespace

void try_epsilon(Trial& trial) {
    const Scene from_light = seen_from_light(trial.scene(), LightSampling::Culled::none);
    if (from_light.triangles.empty()) return;
    const Tracer tracer(from_light, trial.traced().tracer().threads());
    const auto best =
        fitted_bias(trial, sample_light(tracer, {}, trial.sampled_points()), MapBias{});
    if (best && best->bias.constant > 0)
        trial.consider(
            "ray_epsilon", {{"epsilon", best->bias.constant}},
            fmt::format("shadow rays miss what is closer than {:.3g}", best->bias.constant),
            with_epsilon(trial.traced(), best->bias));
}

void try_cube_maps(Trial& trial) {
    if (chosen_light(trial.scene()).kind != Light::Kind::point) return;
    LightSampling ended; // at the range that explains something by itself
    if (const Parameters* found = trial.best_of("shadow_map")) {
        for (const auto& [name, value] : *found) {
            if (name == "range" || name == "far") {
                ended.range = value;
                ended.range_along_axes = name == "far";
            }
            if (name == "dark_outside") ended.beyond_range = Visibility::shadowed;
        }
    }
    std::optional<FittedBias> best;
    LightSampling best_view;
    const int threads = trial.traced().tracer().threads();
    // Of each view the best bias; views are tried side by side.
    const auto look = [&](const Tracer& tracer, const std::vector<LightSampling>& views,
                          bool finely) {
        std::vector<std::optional<FittedBias>> found(views.size());
        parallel_for(static_cast<int>(views.size()), threads, [&](int view, int) {
            const auto i = static_cast<std::size_t>(view);
            const std::vector<LightSample> samples =
                sample_light(tracer, views[i], trial.sampled_points());
            found[i] =
                finely ? fitted_bias(trial, samples) : fitted_bias(trial, samples, MapBias{});
        });
        for (std::size_t i = 0; i < views.size(); ++i) {
            if (!found[i] || (best && found[i]->score <= best->score)) continue;
            best = found[i];
            best_view = views[i];
        }
    };
    using Culled = LightSampling::Culled;
    for (const Culled culled : {Culled::none, Culled::front, Culled::back}) {
        const Scene from_light = seen_from_light(trial.scene(), culled);
        if (from_light.triangles.empty()) return;
        std::vector<LightSampling> views;
        for (int inset = 0; inset <= 1; ++inset)
            for (int texels = smallest_map; texels <= largest_map; texels *= 2) {
                views.push_back(ended);
                views.back().culled = culled;
                views.back().inset = inset;
                views.back().texels = texels;
            }
        const Tracer tracer(from_light, 1);
        look(tracer, views, false);
        look(tracer, filtered(trial, views), false);
    }
    if (!best) return;
    const Scene from_light = seen_from_light(trial.scene(), best_view.culled);
    const Tracer tracer(from_light, 1);
    LightSampling endless = best_view;
    endless.range = infinity;
    look(tracer, {best_view, endless}, true);
    std::vector<LightSampling> alternatives = with_filters(trial, best_view);
    const std::size_t count = alternatives.size();
    for (std::size_t i = 0; i < count; ++i) { // without the right filter, either may fit
        alternatives.push_back(alternatives[i]);
        alternatives.back().inset = 1 - best_view.inset;
    }
    look(tracer, alternatives, true);
    consider_cube(trial, best_view, best->bias);
}

} // namespace shadowproof
