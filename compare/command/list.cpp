#include "compare/command/commands.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/driver/sufficient_depths.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
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

/// What depths are stated for: neither the eye's place nor the light's adds to floats' errors.
Scene stated_picture() {
    Scene scene;
    scene.camera.near = 0.1;
    scene.camera.far = 100;
    scene.camera.half_height = std::tan(glm::radians(30.0));
    scene.lights.emplace_back();
    return scene;
}

SufficientDepths precise_depths(const Technique& technique) {
    const Scene scene = stated_picture();
    return sufficient_depths(scene, technique.depth_model(scene));
}

std::string precise_meaning() {
    const Camera camera = stated_picture().camera;
    return fmt::format("  precise: at which depths a technique's numbers displace a shadow's "
                       "border by one pixel at\n"
                       "  most, where volume and surface meet at 45 degrees; for a near plane of "
                       "{}, a far plane of\n"
                       "  {}, and {} rows of pixels over 60 degrees\n",
                       camera.near, camera.far, camera.height);
}

Json precise_json(const Technique& technique) {
    if (technique.depth_model == nullptr) return nullptr;
    const Camera camera = stated_picture().camera;
    const SufficientDepths depths = precise_depths(technique);
    return {{"near", camera.near},
            {"far", camera.far},
            {"rows", camera.height},
            {"yfov", 60},
            {"from", depths.nearest},
            {"to", std::isfinite(depths.furthest) ? Json(depths.furthest) : Json(nullptr)}};
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
    text += "\nTechniques\n" + precise_meaning();
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
        if (technique.sees_in_parallel) add("cameras", "perspective, orthographic");
        if (!technique.settings.empty())
            add("flags", fmt::format("--{}", fmt::join(technique.settings, ", --")));
        if (technique.depth_model != nullptr)
            add("precise", words_of(precise_depths(technique), stated_picture().camera.near, 1));
        add("cost", fmt::format("{:.2f} x zfail_reversed", technique.cost));
        add("source", technique.source);
    }
    text +=
        "  Any that lights bumps may be joined by + with any that counts volumes in a stencil,\n"
        "  or asks a map that is not filtered: bump_one_pass+zpass_capped lights as the first\n"
        "  where the second finds no shadow.\n";
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
                                      {"orthographic", technique.sees_in_parallel},
                                      {"flags", technique.settings},
                                      {"precise", precise_json(technique)},
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
