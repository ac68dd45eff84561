#include "compare/command/bench/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace shadowproof {

namespace {

std::vector<std::string_view> names_of(const auto& values) {
    std::vector<std::string_view> names;
    for (const auto value : values) names.push_back(name_of(value));
    return names;
}

/// A length of the world in the file's units. Both are floats in the techniques.
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
        SweptSetting{"map-size",
                     {"64", "128", "256", "512", "1024", "2048", "4096", "8192"},
                     [](const Frame& f, double) { return fmt::format("{}", f.mapped->model.size); },
                     {"8192"}},
        SweptSetting{
            "map-bias",
            {"0", "0.001", "0.01", "0.05", "0.15", "0.5"},
            [](const Frame& f, double unit) { return length(f.mapped->model.bias, unit); }},
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

std::vector<BenchSettings> sweep(const Technique& technique, const BenchSettings& fixed,
                                 const BenchSettings& own, bool quick) {
    const auto has = [](const BenchSettings& settings, const auto& matches) {
        return std::any_of(settings.begin(), settings.end(), matches);
    };
    std::vector<BenchSettings> all;
    for (const SweptSetting& setting : swept_settings()) {
        if (!heeds(technique, setting.name) ||
            has(fixed, [&](const auto& each) { return each.first == setting.name; }))
            continue;
        for (const std::string_view value : setting.values) {
            if (quick && std::find(setting.costly.begin(), setting.costly.end(), value) !=
                             setting.costly.end())
                continue;
            if (has(own, [&](const auto& each) {
                    return each.first == setting.name && each.second == value;
                }))
                continue;
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
