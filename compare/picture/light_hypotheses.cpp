#include "compare/picture/hypotheses.h"
#include "compare/picture/light_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A pixel of the sample, by what lights it.
struct Threshold {
    double excess = 0;
    std::int64_t gain = 0; ///< of the score, once the bias reaches it
};

struct BestBias {
    double bias = 0;
    std::int64_t score = 0; ///< pixels that agree with the picture, but for a constant
};

/// The bias by which most is explained less what is contradicted: half way between the pixels that
/// it must light and those that it must not.
std::optional<BestBias> best_bias(const Trial& trial, const std::vector<double>& excess) {
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
    std::optional<BestBias> best;
    for (std::size_t i = 0; i + 1 < thresholds.size(); ++i) {
        score += thresholds[i].gain;
        const double middle = (thresholds[i].excess + thresholds[i + 1].excess) / 2;
        if (std::isfinite(middle) && (!best || score > best->score)) best = {middle, score};
    }
    return best;
}

void consider_map(Trial& trial, const LightSampling& view, double bias) {
    Parameters parameters{{"resolution", view.texels}, {"bias", bias}};
    std::string words =
        fmt::format("a shadow map, cube of {} texels a side, bias {:.3g}", view.texels, bias);
    if (view.culled != LightSampling::Culled::none) {
        const bool front = view.culled == LightSampling::Culled::front;
        parameters.emplace_back(front ? "culls_front" : "culls_back", 1);
        words += front ? ", of back faces" : ", of front faces";
    }
    if (view.inset > 0) {
        parameters.emplace_back("inset", view.inset);
        words += ", whose faces are asked as if a texel narrower";
    }
    if (view.range < infinity) {
        parameters.emplace_back("range", view.range);
        words += fmt::format(", range {:.4g}", view.range);
    }
    trial.consider("shadow_map", parameters, words, lit_within(trial.traced(), view, bias));
}

void try_epsilon(Trial& trial, const Tracer& light_tracer) {
    const auto best = best_bias(trial, excesses(trial.traced(), light_tracer, {}, trial.sample()));
    if (best && best->bias > 0)
        trial.consider("ray_epsilon", {{"epsilon", best->bias}},
                       fmt::format("shadow rays miss what is closer than {:.3g}", best->bias),
                       lit_within(trial.traced(), {}, best->bias));
}

} // namespace

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
    if (chosen_light(trial.scene()).kind != Light::Kind::point) return;
    constexpr int smallest = 64; // texels: engines offer powers of two
    constexpr int largest = 8192;
    std::optional<BestBias> best;
    LightSampling best_view;
    const auto look = [&](const Tracer& tracer, const LightSampling& view) {
        const auto found = best_bias(trial, excesses(trial.traced(), tracer, view, trial.sample()));
        if (!found || (best && found->score <= best->score)) return;
        best = found;
        best_view = view;
    };
    using Culled = LightSampling::Culled;
    for (const Culled culled : {Culled::none, Culled::front, Culled::back}) {
        const Scene from_light = seen_from_light(trial.scene(), culled);
        if (from_light.triangles.empty()) return;
        const Tracer tracer(from_light, trial.traced().tracer().threads());
        for (const int inset : {0, 1})
            for (int texels = smallest; texels <= largest; texels *= 2)
                look(tracer, {.culled = culled, .texels = texels, .inset = inset});
        if (culled == Culled::none) try_epsilon(trial, tracer);
    }
    if (!best) return;
    if (const Parameters* found = trial.best_of("shadow_map")) { // the range alone
        const Scene from_light = seen_from_light(trial.scene(), best_view.culled);
        LightSampling ended = best_view;
        ended.range = found->front().second;
        look(Tracer(from_light, trial.traced().tracer().threads()), ended);
    }
    consider_map(trial, best_view, best->bias);
}

} // namespace shadowproof
