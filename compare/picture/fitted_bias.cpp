#include "compare/picture/fitted_bias.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shadowproof {

namespace {

/// A pixel of the sample, by what lights it.
struct Threshold {
    double excess = 0;
    std::int64_t gain = 0; ///< of the score, once the bias reaches it
};

bool is_directional(const Trial& trial) {
    return chosen_light(trial.scene()).kind == Light::Kind::directional;
}

} // namespace

std::optional<FittedBias> fitted_bias(const Trial& trial, const std::vector<LightSample>& samples,
                                      const MapBias& like) {
    std::vector<Threshold> thresholds;
    thresholds.reserve(samples.size());
    const bool directional = is_directional(trial);
    std::int64_t score = 0; // of the pixels that no bias changes
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const SampledPixel& p = trial.sampled_pixels()[i];
        if (!p.counts) continue;
        const double excess = samples[i].excess(like, directional);
        const std::int64_t gain = trial.frame().claim.at(p.x, p.y) == Visibility::lit ? 1 : -1;
        if (std::isfinite(excess))
            thresholds.push_back({excess, gain});
        else if (excess < 0)
            score += gain;
    }
    std::sort(thresholds.begin(), thresholds.end(),
              [](const Threshold& a, const Threshold& b) { return a.excess < b.excess; });
    std::optional<FittedBias> best;
    for (std::size_t i = 0; i + 1 < thresholds.size(); ++i) {
        score += thresholds[i].gain;
        const double middle = (thresholds[i].excess + thresholds[i + 1].excess) / 2;
        const bool is_tie = thresholds[i].excess == thresholds[i + 1].excess;
        if (is_tie || (best && score <= best->score)) continue;
        best = {like, score};
        best->bias.constant = middle;
    }
    return best;
}

std::optional<FittedBias> fitted_bias(const Trial& trial, const std::vector<LightSample>& samples) {
    std::optional<FittedBias> best;
    const auto look = [&](const MapBias& like) {
        const std::optional<FittedBias> found = fitted_bias(trial, samples, like);
        if (found && (!best || found->score >= best->score + least_gain)) best = found;
    };
    std::vector<BiasOf> numbers{BiasOf::distance};
    if (!is_directional(trial)) {
        numbers.push_back(BiasOf::depth);
        numbers.push_back(BiasOf::inverse_depth);
    }
    for (const BiasOf of : numbers) look({.of = of});
    constexpr double least_slope = 0.25;
    constexpr double largest_slope = 16;
    for (const BiasOf of : numbers)
        for (double slope = least_slope; slope <= largest_slope; slope *= std::numbers::sqrt2)
            look({.of = of, .slope = slope});
    return best;
}

} // namespace shadowproof
