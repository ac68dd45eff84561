#include "compare/command/bench/again.h"

#include "compare/report/escape.h"

#include <fmt/format.h>

namespace shadowproof {

std::string bench_command(const BenchOptions& options, const std::string& scene,
                          const std::string& technique, const BenchSettings& settings_given) {
    std::string command = "shadowproof bench " + shell_quoted(scene);
    if (!technique.empty()) command += " --technique " + technique;
    TechniqueOptions platform; // settings are named one by one, those of other techniques left out
    platform.platform = options.technique.platform;
    for (const auto& [name, value] : settings_given)
        command += fmt::format(" --{} {}", name, shell_quoted(value));
    for (const std::string& word : settings(options.scene, platform))
        command += " " + shell_quoted(word);
    return command;
}

std::vector<std::string> verify_words(const BenchOptions& options, const Scene& scene,
                                      const std::string& argument, const Technique& technique,
                                      const BenchSettings& with) {
    std::vector<std::string> words{"verify", argument, "--technique", std::string(technique.name)};
    for (const auto& [name, value] : with) words.insert(words.end(), {"--" + name, value});
    TechniqueOptions platform; // as in bench_command
    platform.platform = options.technique.platform;
    SceneOptions picture = options.scene;
    if (scene.lights.size() > 1) picture.light = chosen_light(scene).choice;
    for (const std::string& word : settings(picture, platform)) words.push_back(word);
    return words;
}

} // namespace shadowproof
