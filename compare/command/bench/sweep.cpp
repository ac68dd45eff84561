#include "compare/command/bench/sweep.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <optional>

namespace shadowproof {

namespace {

std::vector<std::string_view> names_of(const auto& values) {
    std::vector<std::string_view> names;
    for (const auto value : values) names.push_back(name_of(value));
    return names;
}

/// A length of the world in the file's units, as a float has it.
std::string length(double in_world, double unit) {
    return fmt::format("{}", static_cast<float>(in_world * unit));
}

} // namespace

std::span<const SweptSetting> swept_settings() {
    static const std::array settings{
        SweptSetting{"normalise", names_of(all_normalisations),
                     [](const Frame& f, double) {
                         return std::string(name_of(f.color_model.normalisation));
                     }},
        SweptSetting{
            "bumps", names_of(all_bump_forms),
            [](const Frame& f, double) { return std::string(name_of(f.color_model.bump_form)); }},
        SweptSetting{
            "extrusion",
            {},
            [](const Frame& f, double unit) { return length(f.counted->counting.extrusion, unit); },
            {},
            {0.25, 0.5, 2, 4, 16}},
        SweptSetting{"map-size",
                     {"64", "128", "256", "512", "1024", "2048", "4096", "8192"},
                     [](const Frame& f, double) { return fmt::format("{}", f.mapped->model.size); },
                     {"8192"}},
        SweptSetting{
            "map-bias",
            {"0", "0.001", "0.01", "0.05", "0.15", "0.5"},
            [](const Frame& f, double unit) { return length(f.mapped->model.bias, unit); }},
        SweptSetting{
            "map-slope-bias",
            {"0", "0.5", "1.1", "2", "4"},
            [](const Frame& f, double) { return fmt::format("{}", f.mapped->model.slope_bias); }},
        SweptSetting{
            "map-value", names_of(all_map_values),
            [](const Frame& f, double) { return std::string(name_of(f.mapped->model.value)); }},
        SweptSetting{
            "map-format", names_of(all_map_formats),
            [](const Frame& f, double) { return std::string(name_of(f.mapped->model.format)); }},
        SweptSetting{
            "map-culling", names_of(all_map_cullings),
            [](const Frame& f, double) { return std::string(name_of(f.mapped->model.culling)); }},
        SweptSetting{
            "map-filter",
            {"1", "2", "4", "8"},
            [](const Frame& f, double) { return fmt::format("{}", f.mapped->model.filter); }},
        SweptSetting{
            "map-average", names_of(all_map_averages),
            [](const Frame& f, double) { return std::string(name_of(f.mapped->model.average)); }},
        SweptSetting{
            "ray-epsilon",
            {"0", "1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1"},
            [](const Frame& f, double unit) { return length(f.rays->model.distance, unit); }},
        SweptSetting{
            "ray-offset",
            {"0", "1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1"},
            [](const Frame& f, double unit) { return length(f.rays->model.distance, unit); }},
    };
    return settings;
}

TechniqueOptions with_settings(TechniqueOptions options, const BenchSettings& settings) {
    CLI::App parser;
    add_technique_flags(parser, options);
    std::vector<std::string> words; // CLI11 takes them from the back
    for (const auto& [name, value] : settings) {
        words.push_back(value);
        words.push_back("--" + name);
    }
    parser.parse(std::move(words));
    return options;
}

BenchSettings own_settings(const Technique& technique, const Frame& frame, double unit) {
    BenchSettings own;
    for (const SweptSetting& setting : swept_settings())
        if (heeds(technique, setting.name))
            own.emplace_back(setting.name, setting.own(frame, unit));
    return own;
}

namespace {

/// The values that are tried beside the technique's own, if it heeds the setting.
std::vector<std::string> values_beside(const SweptSetting& setting, const std::string& own,
                                       bool quick) {
    std::vector<std::string> values;
    for (const std::string_view value : setting.values)
        if (value != own && !(quick && std::ranges::count(setting.costly, value) > 0))
            values.emplace_back(value);
    for (const double factor : setting.factors)
        if (const std::optional<double> number = parse_number(own))
            values.push_back(fmt::format("{:.3g}", factor * *number));
    return values;
}

} // namespace

std::vector<BenchSettings> sweep(const Technique& technique, const BenchSettings& fixed,
                                 const BenchSettings& own, bool quick) {
    const auto find = [](const BenchSettings& settings, std::string_view name) {
        return std::ranges::find_if(settings, [&](const auto& each) { return each.first == name; });
    };
    std::vector<BenchSettings> all;
    for (const SweptSetting& setting : swept_settings()) {
        if (!heeds(technique, setting.name) || find(fixed, setting.name) != fixed.end()) continue;
        const auto its_own = find(own, setting.name);
        for (const std::string& value :
             values_beside(setting, its_own == own.end() ? "" : its_own->second, quick)) {
            BenchSettings settings = fixed;
            settings.emplace_back(setting.name, value);
            all.push_back(std::move(settings));
        }
    }
    return all;
}

BenchSettings fixed_settings(const CLI::App& command) {
    BenchSettings fixed;
    for (const SweptSetting& setting : swept_settings()) {
        const CLI::Option* flag = command.get_option("--" + std::string(setting.name));
        if (flag->count() > 0) fixed.emplace_back(setting.name, flag->results().back());
    }
    return fixed;
}

} // namespace shadowproof
