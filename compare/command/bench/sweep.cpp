#include "compare/command/bench/sweep.h"

#include <algorithm>
#include <array>

namespace shadowproof {

namespace {

bool lights_bumps(const Technique& technique) {
    return technique.needs_bump_maps;
}

std::vector<std::string_view> names_of(const auto& values) {
    std::vector<std::string_view> names;
    for (const auto value : values) names.push_back(name_of(value));
    return names;
}

} // namespace

std::span<const SweptSetting> swept_settings() {
    static const std::array settings{
        SweptSetting{
            "normalise", names_of(all_normalisations), lights_bumps,
            [](const Frame& f) { return std::string(name_of(f.color_model.normalisation)); }},
        SweptSetting{"bumps", names_of(all_bump_forms), lights_bumps,
                     [](const Frame& f) { return std::string(name_of(f.color_model.bump_form)); }},
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

BenchSettings own_settings(const Technique& technique, const Frame& frame) {
    BenchSettings own;
    for (const SweptSetting& setting : swept_settings())
        if (setting.matters(technique)) own.emplace_back(setting.name, setting.own(frame));
    return own;
}

std::vector<BenchSettings> sweep(const Technique& technique, const BenchSettings& fixed,
                                 const BenchSettings& own) {
    const auto has = [](const BenchSettings& settings, const auto& matches) {
        return std::any_of(settings.begin(), settings.end(), matches);
    };
    std::vector<BenchSettings> all;
    for (const SweptSetting& setting : swept_settings()) {
        if (!setting.matters(technique) ||
            has(fixed, [&](const auto& each) { return each.first == setting.name; }))
            continue;
        for (const std::string_view value : setting.values) {
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
