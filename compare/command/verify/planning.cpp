#include "compare/command/verify/planning.h"

#include "compare/command/scene_result.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <filesystem>
#include <new>

namespace shadowproof {

SceneRequest request_of(const VerifyOptions& options) {
    SceneRequest request = options.scene.request();
    // A position that is given is of one light.
    request.every_light = !request.light && !request.view.light_position;
    return request;
}

Scene read_scene(const WorkerSetup& setup, const std::string& argument) {
    setup.console.progress(argument + ": reading");
    return setup.pieces.step(argument + ": reading",
                             [&] { return load_scene(argument, request_of(setup.options)); });
}

std::vector<const Technique*> techniques_for(const VerifyOptions& options, const Scene& scene) {
    std::vector<const Technique*> chosen = options.technique.chosen();
    const bool named = !options.scenes.empty() && !options.technique.techniques.empty();
    if (!named) std::erase_if(chosen, [&](const Technique* one) { return !suits(*one, scene); });
    return chosen;
}

std::string name_of_file(const std::string& argument) {
    return std::filesystem::path(argument).stem().string();
}

std::string name_of_result(const Scene& scene, bool one_of_many,
                           std::span<const SceneResult> before) {
    const std::string& choice = chosen_light(scene).choice;
    return unique_name(before, one_of_many ? scene.name + "-" + choice : scene.name);
}

namespace {

/// What the whole run tries of a scene; nothing where no technique is for it. Adds the names of its
/// results to those before.
PlannedScene planned_scene(const WorkerSetup& setup, const std::string& argument,
                           std::vector<SceneResult>& before) {
    PlannedScene planned{.argument = argument};
    const auto add = [&](const std::string& name, std::uint64_t triangles) -> PlannedLight& {
        before.emplace_back().name = name;
        return planned.lights.emplace_back(
            PlannedLight{.name = name, .triangles = triangles, .techniques = {}});
    };
    try {
        Scene scene = read_scene(setup, argument);
        const std::size_t lights = request_of(setup.options).every_light ? scene.lights.size() : 1;
        for (std::size_t i = 0; i < lights; ++i) {
            if (lights > 1) scene.light = i;
            const auto techniques = techniques_for(setup.options, scene);
            if (techniques.empty()) {
                planned.lights.emplace_back(PlannedLight{.techniques = {}, .tried = false});
                continue;
            }
            PlannedLight& light =
                add(name_of_result(scene, lights > 1, before), scene.triangles.size());
            light.content = content_of(scene);
            for (const Technique* technique : techniques)
                light.techniques.emplace_back(technique->name);
        }
        return planned;
    } catch (const std::bad_alloc&) { // one result says why, in the shard that has it
    } catch (const Error&) {
    }
    add(unique_name(before, name_of_file(argument)), 0);
    return planned;
}

} // namespace

PlannedShard planned_shard(const WorkerSetup& setup) {
    return setup.pieces.piece("planning", [&] {
        std::vector<PlannedScene> whole;
        std::vector<SceneResult> names;
        for (const std::string& argument : scenes_to_verify(setup.options))
            whole.push_back(planned_scene(setup, argument, names));
        return PlannedShard{part_of(whole, *setup.options.shard, setup.costs),
                            plan_name(whole, setup.costs)};
    });
}

} // namespace shadowproof
