#include "compare/bench/bench_table.h"

#include "compare/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

double share(double pixels, std::uint64_t all) {
    return 100.0 * pixels / static_cast<double>(all);
}

std::string causes_beyond_edges(const BenchError& error) {
    std::string words;
    for (const auto& [cause, pixels] : error.causes)
        if (cause != "edge")
            words += fmt::format("{}{} {}", words.empty() ? "" : ", ", cause, grouped(pixels));
    return words;
}

std::string interval_words(const TimeInterval& ms) {
    return ms.is_known ? fmt::format("{:.2f} {:>8.2f}", ms.low, ms.high) : "no interval";
}

std::string short_name_of(const BenchPoint& point) {
    return point.settings.empty() ? point.technique
                                  : point.technique + " " + words_of(point.settings);
}

} // namespace

std::uint64_t wrong_pixels(const BenchError& error) {
    for (const auto& [cause, pixels] : error.causes)
        if (cause == "edge") return error.differing - pixels;
    return error.differing;
}

std::string words_of(const BenchSettings& settings) {
    std::string words;
    for (const auto& [name, value] : settings)
        words += fmt::format("{}{}={}", words.empty() ? "" : " ", name, value);
    return words;
}

const BenchPoint* find_point(const BenchRun& run, const BenchPoint& like) {
    for (const BenchPoint& point : run.points)
        if (point.scene == like.scene && point.technique == like.technique &&
            point.settings == like.settings)
            return &point;
    return nullptr;
}

bool is_on_front(const BenchRun& run, const BenchPoint& point) {
    if (point.technique == truth_point) return false;
    const double ms = median_interval(point.samples).median;
    const std::uint64_t wrong = wrong_pixels(point.error);
    return std::none_of(run.points.begin(), run.points.end(), [&](const BenchPoint& other) {
        if (other.scene != point.scene || other.technique == truth_point) return false;
        const double other_ms = median_interval(other.samples).median;
        const std::uint64_t other_wrong = wrong_pixels(other.error);
        return other_ms <= ms && other_wrong <= wrong && (other_ms < ms || other_wrong < wrong);
    });
}

std::vector<std::string> bench_table(const BenchRun& run, const std::string& scene) {
    std::vector<const BenchPoint*> points;
    std::size_t width = 9;
    for (const BenchPoint& point : run.points)
        if (point.scene == scene) {
            points.push_back(&point);
            width = std::max(width, name_of(point).size());
        }
    if (points.empty()) return {};
    std::stable_sort(points.begin(), points.end(), [](const BenchPoint* a, const BenchPoint* b) {
        return median_interval(a->samples).median < median_interval(b->samples).median;
    });
    const bool colors = std::any_of(points.begin(), points.end(),
                                    [](const BenchPoint* point) { return point->error.color; });
    std::vector<std::string> lines;
    lines.push_back(fmt::format("  {:<{}}  {:>9}  {:>17}  {:>3}  {:>9}  {:>9}  {:>9}{}",
                                "technique", width, "median ms", "95 % within", "n", "wrong %",
                                "f. lit %", "f. dark %", colors ? "   rmse  99.9 %     max" : ""));
    for (const BenchPoint* point : points) {
        const TimeInterval ms = median_interval(point->samples);
        const BenchError& error = point->error;
        std::string line = fmt::format(
            "{} {:<{}}  {:>9.2f}  {:>17}  {:>3}  {:>9.4f}  {:>9.4f}  {:>9.4f}",
            is_on_front(run, *point) ? "*" : " ", short_name_of(*point), width, ms.median,
            interval_words(ms), point->samples.size(),
            share(static_cast<double>(wrong_pixels(error)), error.pixels),
            share(error.falsely_lit, error.pixels), share(error.falsely_shadowed, error.pixels));
        if (error.color)
            line += fmt::format("{:>7.2f}{:>8.2f}{:>8.2f}", error.color->rmse,
                                error.color->percentile999, error.color->largest);
        else if (colors)
            line += std::string(23, ' ');
        const std::string causes = causes_beyond_edges(error);
        lines.push_back(causes.empty() ? line : line + "  " + causes);
    }
    return lines;
}

std::vector<std::string> growth_table(const BenchRun& run) {
    if (run.growth.empty()) return {};
    std::size_t axis = 4;
    std::size_t width = 9;
    for (const Growth& growth : run.growth) {
        axis = std::max(axis, growth.axis.size());
        width = std::max(width, growth.technique.size());
    }
    std::vector<std::string> lines{fmt::format("  {:<{}}  {:<{}}  {:>8}  {:>15}  {}", "axis", axis,
                                               "technique", width, "exponent", "95 % within",
                                               "median ms by size")};
    for (const Growth& growth : run.growth) {
        const std::optional<Exponent> exponent = exponent_of(growth.points);
        std::string line =
            fmt::format("  {:<{}}  {:<{}}  ", growth.axis, axis, growth.technique, width);
        line += exponent ? fmt::format("{:>8.2f}  {:>7.2f} {:>7.2f}", exponent->value,
                                       exponent->low, exponent->high)
                         : fmt::format("{:>8}  {:>15}", "-", "-");
        line += " ";
        for (const GrowthPoint& point : growth.points)
            line += fmt::format(" {}:{:.2f}", grouped(static_cast<std::uint64_t>(point.size)),
                                median_interval(point.samples).median);
        if (const auto broken = break_of(growth.points))
            line += fmt::format("  breaks at {}: {:.2f}, then {:.2f}",
                                grouped(static_cast<std::uint64_t>(broken->size)),
                                broken->below.value, broken->above.value);
        lines.push_back(line);
    }
    return lines;
}

} // namespace shadowproof
