#include "compare/picture/shadow_steps.h"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <numbers>
#include <utility>

namespace shadowproof {

ShadowSteps shadow_steps(const Trial& trial, const LightAxes& axes) {
    constexpr std::size_t most = 4096; // more tell nothing new, and cost time
    const Light& light = chosen_light(trial.scene());
    const Image<Visibility>& claim = trial.frame().claim;
    ShadowSteps found;
    found.axes = axes;
    std::vector<double> apart;
    const auto add = [&](int x, int y, int u, int v) {
        if (claim.at(x, y) == claim.at(u, v) || !trial.is_decidable(x, y) ||
            !trial.is_decidable(u, v) ||
            trial.truth().triangle.at(x, y) != trial.truth().triangle.at(u, v))
            return;
        const glm::dvec2 a(place_from_light(light, axes, seen_point(trial.traced(), x, y)));
        const glm::dvec2 b(place_from_light(light, axes, seen_point(trial.traced(), u, v)));
        const glm::dvec2 size = glm::abs(b - a);
        if (!(size.x + size.y > 0)) return;
        found.steps.push_back({(a + b) / 2.0, size});
        apart.push_back(std::max(size.x, size.y));
        found.low = glm::min(found.low, found.steps.back().middle);
        found.high = glm::max(found.high, found.steps.back().middle);
    };
    for (int y = 0; y + 1 < claim.height; ++y)
        for (int x = 0; x + 1 < claim.width; ++x) {
            add(x, y, x + 1, y);
            add(x, y, x, y + 1);
        }
    if (apart.empty()) return found;
    const auto quarter = apart.begin() + std::ssize(apart) / 4;
    std::nth_element(apart.begin(), quarter, apart.end());
    found.apart = *quarter;
    const std::size_t every = (found.steps.size() + most - 1) / most;
    std::vector<ShadowStep> kept;
    for (std::size_t i = 0; i < found.steps.size(); i += every) kept.push_back(found.steps[i]);
    found.steps = std::move(kept);
    return found;
}

std::vector<Wave> waves_of(const ShadowSteps& steps, double first, double step, int count) {
    const auto turned = [](double turns) { return std::polar(1.0, 2 * std::numbers::pi * turns); };
    std::vector<Wave> waves(static_cast<std::size_t>(count));
    std::array<double, 2> sum{};
    for (const ShadowStep& each : steps.steps)
        for (int k = 0; k < 2; ++k) {
            const double weight = each.weight()[k];
            sum[static_cast<std::size_t>(k)] += weight;
            std::complex<double> wave = turned(first * each.middle[k]);
            const std::complex<double> turn = turned(step * each.middle[k]);
            for (Wave& at : waves) {
                at.mean[static_cast<std::size_t>(k)] += weight * wave;
                wave *= turn;
            }
        }
    for (int i = 0; i < count; ++i) {
        Wave& wave = waves[static_cast<std::size_t>(i)];
        wave.frequency = first + i * step;
        for (std::size_t k = 0; k < 2; ++k)
            if (sum[k] > 0) wave.mean[k] /= sum[k];
    }
    return waves;
}

std::vector<Wave> peaks(const std::vector<Wave>& waves, std::size_t most) {
    constexpr std::size_t around = 24;
    std::vector<double> sums{0};
    for (const Wave& wave : waves) sums.push_back(sums.back() + wave.power());
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t i = 1; i + 1 < waves.size(); ++i) {
        const double power = waves[i].power();
        if (power < waves[i - 1].power() || power <= waves[i + 1].power()) continue;
        const std::size_t from = i - std::min(i, around);
        const std::size_t to = std::min(i + around + 1, waves.size());
        found.emplace_back(power * static_cast<double>(to - from) / (sums[to] - sums[from]), i);
    }
    std::sort(found.begin(), found.end(), std::greater<>());
    found.resize(std::min(found.size(), most));
    std::vector<Wave> sharpest;
    for (const auto& [ratio, i] : found) sharpest.push_back(waves[i]);
    return sharpest;
}

} // namespace shadowproof
