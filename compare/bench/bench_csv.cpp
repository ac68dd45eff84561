#include "compare/bench/bench_csv.h"

#include "scenes/cause.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

/// In quotes where it holds what separates.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::uint64_t pixels_by(const BenchError& error, std::string_view cause) {
    for (const auto& [name, pixels] : error.causes)
        if (name == cause) return pixels;
    return 0;
}

std::vector<std::string> causes_in(const BenchRun& run) {
    std::vector<std::string> names;
    for (const CauseWords& words : all_causes)
        if (std::any_of(run.points.begin(), run.points.end(), [&](const BenchPoint& point) {
                return pixels_by(point.error, words.name) > 0;
            }))
            names.emplace_back(words.name);
    return names;
}

std::vector<std::string> stages_in(const BenchRun& run) {
    std::vector<std::string> names;
    for (const BenchPoint& point : run.points)
        for (const BenchStage& stage : point.stages)
            if (std::find(names.begin(), names.end(), stage.name) == names.end())
                names.push_back(stage.name);
    return names;
}

/// Both ends of the interval; two empty fields where there is none.
std::string interval_fields(const TimeInterval& ms) {
    return ms.is_known ? fmt::format("{},{}", ms.low, ms.high) : ",";
}

/// The median of a stage; empty where the point has none.
std::string stage_of(const BenchPoint& point, const std::string& name) {
    for (const BenchStage& stage : point.stages)
        if (stage.name == name) return fmt::format("{}", median_interval(stage.samples).median);
    return {};
}

} // namespace

std::string growth_csv(const BenchRun& run) {
    std::string csv = "axis,scene,technique,size,ms_median,ms_low,ms_high,samples,settled,exponent,"
                      "exponent_low,exponent_high,break_size,exponent_below,exponent_above,"
                      "command\r\n";
    for (const Growth& growth : run.growth) {
        const std::optional<Exponent> exponent = exponent_of(growth.points);
        const std::optional<GrowthBreak> broken = break_of(growth.points);
        std::string fit =
            exponent ? fmt::format("{},{},{}", exponent->value, exponent->low, exponent->high)
                     : ",,";
        fit += broken ? fmt::format(",{},{},{}", broken->size, broken->below.value,
                                    broken->above.value)
                      : ",,,";
        for (const GrowthPoint& point : growth.points) {
            const TimeInterval ms = median_interval(point.samples);
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\r\n", field(growth.axis),
                               field(growth.scene), field(growth.technique), point.size, ms.median,
                               interval_fields(ms), point.samples.size(), is_settled(point.samples),
                               fit, field(growth.command));
        }
    }
    return csv;
}

std::string bench_csv(const BenchRun& run) {
    if (run.points.empty() && !run.growth.empty()) return growth_csv(run);
    const std::vector<std::string> causes = causes_in(run);
    std::string csv = "scene,technique,settings,ms_median,ms_low,ms_high,samples,settled,pixels,"
                      "wrong,wrong_share,falsely_lit_share,falsely_shadowed_share,color_rmse,"
                      "color_p999,color_largest";
    for (const std::string& cause : causes) csv += "," + cause;
    const std::vector<std::string> stages = stages_in(run);
    for (const std::string& stage : stages) csv += fmt::format(",ms_{}", stage);
    csv += ",command\r\n";
    for (const BenchPoint& point : run.points) {
        const TimeInterval ms = median_interval(point.samples);
        const BenchError& error = point.error;
        const auto share = [&](double pixels) {
            return pixels / static_cast<double>(error.pixels);
        };
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", field(point.scene),
                           field(point.technique), field(words_of(point.settings)), ms.median,
                           interval_fields(ms), point.samples.size(), is_settled(point.samples),
                           error.pixels, wrong_pixels(error),
                           share(static_cast<double>(wrong_pixels(error))),
                           share(error.falsely_lit), share(error.falsely_shadowed));
        csv += error.color ? fmt::format(",{},{},{}", error.color->rmse, error.color->percentile999,
                                         error.color->largest)
                           : ",,,";
        for (const std::string& cause : causes) csv += fmt::format(",{}", pixels_by(error, cause));
        for (const std::string& stage : stages) csv += "," + stage_of(point, stage);
        csv += "," + field(point.command) + "\r\n";
    }
    return csv;
}

} // namespace shadowproof
