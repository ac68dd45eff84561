#include "compare/command/commands.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

std::string fails_at(const Technique& technique) {
    std::string names;
    for (const Cause cause : technique.fails_at)
        names += (names.empty() ? "" : ", ") + std::string(name_of(cause));
    return names.empty() ? "nothing" : names;
}

std::vector<std::string_view> kinds_of_light(const Technique& technique) {
    std::vector<std::string_view> names;
    for (const Light::Kind kind : {Light::Kind::point, Light::Kind::spot, Light::Kind::directional})
        if (is_for(technique, kind)) names.push_back(name_of(kind));
    return names;
}

std::string as_text() {
    std::size_t width = 0; // of the longest name
    for (const BundledScene& scene : bundled_scenes()) width = std::max(width, scene.name.size());
    for (const Technique& technique : all_techniques())
        width = std::max(width, technique.name.size());
    width += 2;
    std::string text = "Scenes\n";
    for (const BundledScene& scene : bundled_scenes())
        text += fmt::format("  {:<{}}{}\n", scene.name, width, scene.summary);
    text += "\nTechniques\n";
    for (const Technique& technique : all_techniques()) {
        text += fmt::format("  {:<{}}{}\n", technique.name, width, technique.summary);
        const auto add = [&](std::string_view what, std::string_view words) {
            text += fmt::format("{:{}}{}: {}\n", "", width + 2, what, words);
        };
        add("fails at", fails_at(technique));
        add("needs", technique.needs);
        if (technique.needs_bump_maps)
            add("for", technique.needs_environment
                           ? "scenes with bump maps and an environment alone"
                           : "scenes with bump maps and no environment");
        if (!technique.lights.empty())
            add("lights", fmt::format("{}", fmt::join(kinds_of_light(technique), ", ")));
        if (!technique.settings.empty())
            add("flags", fmt::format("--{}", fmt::join(technique.settings, ", --")));
        add("cost", fmt::format("{:.2f} x zfail_reversed", technique.cost));
        add("source", technique.source);
    }
    text += "\nCauses\n";
    for (const CauseWords& words : all_causes)
        text += fmt::format("  {:<{}}{}\n", words.name, width, words.meaning);
    return text;
}

Json as_json() {
    Json json{{"schema", "shadowproof/list/1"}};
    for (const BundledScene& scene : bundled_scenes())
        json["scenes"].push_back({{"name", scene.name}, {"summary", scene.summary}});
    for (const Technique& technique : all_techniques()) {
        Json causes = Json::array();
        for (const Cause cause : technique.fails_at) causes.push_back(name_of(cause));
        Json by_nature = Json::array();
        for (const Cause cause : technique.by_nature) by_nature.push_back(name_of(cause));
        json["techniques"].push_back({{"name", technique.name},
                                      {"summary", technique.summary},
                                      {"source", technique.source},
                                      {"needs", technique.needs},
                                      {"needs_bump_maps", technique.needs_bump_maps},
                                      {"needs_environment", technique.needs_environment},
                                      {"lights", kinds_of_light(technique)},
                                      {"flags", technique.settings},
                                      {"cost", technique.cost},
                                      {"fails_at", causes},
                                      {"by_nature", by_nature}});
    }
    for (const CauseWords& words : all_causes)
        json["causes"].push_back({{"name", words.name}, {"meaning", words.meaning}});
    return json;
}

} // namespace

Work add_list(CLI::App& app) {
    CLI::App* command = app.add_subcommand("list", "Scenes, techniques and causes");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "As JSON");
    return [json] {
        print(*json ? as_json().dump(1) + "\n" : as_text());
        return exit_passed;
    };
}

} // namespace shadowproof
