#include "compare/command/commands.h"
#include "scenes/catalog.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

std::string fails_at(const Technique& technique) {
    std::string names;
    for (const Cause cause : technique.fails_at)
        names += (names.empty() ? "" : ", ") + std::string(name_of(cause));
    return names.empty() ? "nothing" : names;
}

std::string as_text() {
    std::string text = "Scenes\n";
    for (const BundledScene& scene : bundled_scenes())
        text += fmt::format("  {:<16}{}\n", scene.name, scene.summary);
    text += "\nTechniques\n";
    for (const Technique& technique : all_techniques())
        text += fmt::format("  {:<16}{}\n{:18}fails at: {}\n{:18}needs: {}\n{:18}source: {}\n",
                            technique.name, technique.summary, "", fails_at(technique), "",
                            technique.needs, "", technique.source);
    text += "\nCauses\n";
    for (const CauseWords& words : all_causes)
        text += fmt::format("  {:<16}{}\n", words.name, words.meaning);
    return text;
}

Json as_json() {
    Json json{{"schema", "shadowproof/list/1"}};
    for (const BundledScene& scene : bundled_scenes())
        json["scenes"].push_back({{"name", scene.name}, {"summary", scene.summary}});
    for (const Technique& technique : all_techniques()) {
        Json causes = Json::array();
        for (const Cause cause : technique.fails_at) causes.push_back(name_of(cause));
        json["techniques"].push_back({{"name", technique.name},
                                      {"summary", technique.summary},
                                      {"source", technique.source},
                                      {"needs", technique.needs},
                                      {"fails_at", causes}});
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
        fmt::print("{}", *json ? as_json().dump(1) + "\n" : as_text());
        return exit_passed;
    };
}

} // namespace shadowproof
