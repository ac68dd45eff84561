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
            "cube-size",
            {"8", "16", "32", "128", "256"}, // and 64, as cube-map alone has it
            [](const Frame& f, double) { return fmt::format("{}", f.color_model.cube_size); },
            {},
            {},
            {"normalise", name_of(Normalisation::cube_map)}},
        SweptSetting{
            "newton-steps",
            {"0", "2", "3"}, // and 1, as newton-raphson alone has it
            [](const Frame& f, double) { return fmt::format("{}", f.color_model.newton_steps); },
            {},
            {},
            {"normalise", name_of(Normalisation::newton_raphson)}},
        SweptSetting{
            "bumps", names_of(all_bump_forms),
            [](const Frame& f, double) { return std::string(name_of(f.color_model.bump_form)); }},
        SweptSetting{
            "vectors", names_of(all_vector_origins),
            [](const Frame& f, double) { return std::string(name_of(f.color_model.vectors)); }},
        SweptSetting{
            "tangents", names_of(all_tangent_sources),
            [](const Frame& f, double) { return std::string(name_of(f.color_model.tangents)); }},
        SweptSetting{
            "anisotropy",
            {"1", "2", "4", "8", "16"},
            [](const Frame& f, double) { return fmt::format("{}", f.color_model.anisotropy); }},
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
            "map-value", names_of(all_map_values),
            [](const Frame& f, double) { return std::string(name_of(f.mapped->model.value)); }},
        SweptSetting{
            "map-slope-bias",
            {"0", "0.5", "1.1", "2", "4"},
            [](const Frame& f, double) { return fmt::format("{}", f.mapped->model.slope_bias); },
            {},
            {},
            {"map-value", name_of(MapValue::depth)}},
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
            "map-edges", names_of(all_map_edges),
            [](const Frame& f, double) { return std::string(name_of(f.mapped->model.edges)); }},
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

namespace {

const std::string* value_of(const BenchSettings& settings, std::string_view name) {
    const auto found =
        std::ranges::find_if(settings, [&](const auto& each) { return each.first == name; });
    return found == settings.end() ? nullptr : &found->second;
}

/// Whether a setting of the technique does anything beside these. Where the technique leaves no
/// choice of what the setting needs, it has it.
bool does_something(const SweptSetting& setting, const Technique& technique,
                    const BenchSettings& beside) {
    const auto& [name, value] = setting.within;
    if (name.empty() || !heeds(technique, name)) return true;
    const std::string* const is = value_of(beside, name);
    return is != nullptr && *is == value;
}

} // namespace

BenchSettings own_settings(const Technique& technique, const Frame& frame, double unit) {
    BenchSettings own;
    for (const SweptSetting& setting : swept_settings())
        if (heeds(technique, setting.name) && does_something(setting, technique, own))
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
    std::vector<BenchSettings> all;
    for (const SweptSetting& setting : swept_settings()) {
        if (!heeds(technique, setting.name) || value_of(fixed, setting.name) != nullptr) continue;
        BenchSettings beside = fixed;
        if (!does_something(setting, technique, own)) {
            const auto& [name, value] = setting.within;
            if (value_of(fixed, name) != nullptr) continue; // to what makes it do nothing
            beside.emplace_back(name, value);
        }
        const std::string* const its_own = value_of(own, setting.name);
        for (const std::string& value :
             values_beside(setting, its_own == nullptr ? "" : *its_own, quick)) {
            all.push_back(beside);
            all.back().emplace_back(setting.name, value);
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
