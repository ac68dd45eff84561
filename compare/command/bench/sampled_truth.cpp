#include "compare/command/bench/sampled_truth.h"

#include "compare/command/process/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

namespace shadowproof {

std::vector<int> sampled_sides(bool quick) {
    return quick ? std::vector{1, 2, 4, 8} : std::vector{1, 2, 4, 8, 16, 32};
}

BenchSettings samples_setting(int side) {
    return {{"samples", fmt::format("{}", side * side)}};
}

int side_of(const BenchSettings& settings) {
    for (const auto& [name, value] : settings)
        if (name == "samples") return static_cast<int>(std::lround(std::sqrt(std::stod(value))));
    return 0;
}

BenchColor color_distance(const Supersampled& picture, const Supersampled& yardstick) {
    std::vector<double> errors;
    double squares = 0;
    for (std::size_t i = 0; i < yardstick.color.pixels.size(); ++i) {
        if (yardstick.coverage.pixels[i] < 1) continue;
        const glm::dvec3 off = 255.0 * glm::abs(glm::clamp(picture.color.pixels[i], 0.0, 1.0) -
                                                glm::clamp(yardstick.color.pixels[i], 0.0, 1.0));
        errors.push_back(std::max({off.x, off.y, off.z}));
        squares += glm::dot(off, off);
    }
    if (errors.empty()) return {};
    std::ranges::sort(errors);
    const std::size_t rank = (errors.size() * 999 + 999) / 1000 - 1;
    return {.rmse = std::sqrt(squares / (3 * static_cast<double>(errors.size()))),
            .largest = errors.back(),
            .percentile999 = errors[rank]};
}

std::vector<BenchPoint> judge_sampled(const TracedScene& traced, const BenchPoint& truth,
                                      const std::vector<int>& sides) {
    const TracedLights& before = traced.lights_before();
    const auto sampled = [&](int side) {
        return shade_supersampled(traced.tracer(), side, before);
    };
    const Stopwatch stopwatch;
    const Supersampled yardstick = sampled(sides.back());
    const double milliseconds = stopwatch.milliseconds();
    std::vector<BenchPoint> points;
    for (const int side : sides) {
        BenchPoint& point = points.emplace_back(truth);
        point.settings = samples_setting(side);
        point.samples.clear();
        point.error.color =
            side == sides.back() ? BenchColor{} : color_distance(sampled(side), yardstick);
    }
    points.back().samples = {milliseconds};
    return points;
}

} // namespace shadowproof
