#include "compare/results/joined_lights.h"

#include "compare/results/results_check.h"
#include "compare/verdict.h"

#include <algorithm>
#include <span>
#include <string>

namespace shadowproof {

namespace {

using Json = ResultsJson;

/// A scene under all of its lights: the results of one file, which follow each other.
struct Lights {
    std::span<MergedScene> scenes;
    std::string bundled; ///< the scene's name, if it is one
    bool joined = false; ///< of several runs
};

/// The bundled scene that all cells of a scene are of; empty: none.
std::string bundled_scene(const MergedScene& scene, const Matrix& matrix) {
    if (scene.cells.empty()) return {};
    const std::string& name = scene.cells.front().what.verified;
    const bool same = std::ranges::all_of(
        scene.cells, [&](const MergedCell& cell) { return cell.what.verified == name; });
    const bool known = std::ranges::find(matrix.scenes, name) != matrix.scenes.end();
    return same && known ? name : std::string();
}

std::vector<Lights> lights_of(std::vector<MergedScene>& scenes, const Matrix& matrix) {
    std::vector<Lights> all;
    for (std::size_t begin = 0; begin < scenes.size();) {
        Lights lights{{}, bundled_scene(scenes[begin], matrix), scenes[begin].of_several_runs};
        std::size_t end = begin + 1;
        for (; !lights.bundled.empty() && end < scenes.size() &&
               bundled_scene(scenes[end], matrix) == lights.bundled;
             ++end)
            lights.joined = lights.joined || scenes[end].of_several_runs ||
                            scenes[end].run != scenes[begin].run;
        lights.scenes = std::span(scenes).subspan(begin, end - begin);
        all.push_back(lights);
        begin = end;
    }
    return all;
}

bool shows(const Lights& lights, Cause cause) {
    return std::ranges::any_of(lights.scenes, [&](const MergedScene& scene) {
        return std::ranges::any_of(scene.cells, [&](const MergedCell& cell) {
            return ((cell.what.causes >> static_cast<unsigned>(cause)) & 1U) != 0;
        });
    });
}

bool is_for(const KnownTechnique& technique, const MergedScene& scene) {
    return technique.lights.empty() ||
           std::ranges::find(technique.lights, scene.head.value("light_kind", "")) !=
               technique.lights.end();
}

/// Whether all techniques ran on a bundled scene's default picture: only that shows what the scene
/// stopped provoking. A technique that could not run may be the one that shows it.
bool is_whole(const Lights& lights, const Json& arguments, const Matrix& matrix) {
    if (lights.bundled.empty() || !is_default_picture(arguments.get<std::vector<std::string>>()))
        return false;
    for (const MergedScene& scene : lights.scenes)
        if (!scene.head.contains("light_kind")) return false; // of an older version
    return std::ranges::all_of(lights.scenes, [&](const MergedScene& scene) {
        return std::ranges::all_of(matrix.techniques, [&](const KnownTechnique& technique) {
            return !technique.on_every_scene || !is_for(technique, scene) ||
                   std::ranges::any_of(scene.cells, [&](const MergedCell& cell) {
                       return cell.what.name == technique.name && !cell.what.could_not_run;
                   });
        });
    });
}

Json stopped_provoking(const Lights& lights, const Matrix& matrix) {
    std::vector<Cause> provokes;
    for (const Json& cause : lights.scenes.front().head.at("provokes"))
        provokes.push_back(*cause_named(cause.get_ref<const std::string&>()));
    std::vector<std::vector<Cause>> fails_at;
    for (const KnownTechnique& technique : matrix.techniques)
        if (technique.on_every_scene && std::ranges::any_of(lights.scenes, [&](const auto& scene) {
                return is_for(technique, scene);
            }))
            fails_at.push_back(technique.fails_at);
    Json stopped = Json::array();
    for (const Cause cause :
         no_longer_provoked(provokes, fails_at, [&](Cause shown) { return shows(lights, shown); }))
        stopped.push_back(name_of(cause));
    return stopped;
}

void settle(const Lights& lights, const Json& arguments, const Matrix& matrix) {
    if (is_whole(lights, arguments, matrix)) {
        lights.scenes.back().head["no_longer_provoked"] = stopped_provoking(lights, matrix);
        return;
    }
    for (MergedScene& scene : lights.scenes) {
        if (could_not_run(scene.head)) continue;
        Json still = Json::array();
        for (const Json& cause : scene.head.at("no_longer_provoked"))
            if (!shows(lights, *cause_named(cause.get_ref<const std::string&>())))
                still.push_back(cause);
        scene.head["no_longer_provoked"] = still;
    }
}

} // namespace

void settle_what_is_provoked(std::vector<MergedScene>& scenes, const Json& arguments,
                             const Matrix& matrix) {
    for (const Lights& lights : lights_of(scenes, matrix))
        if (lights.joined) settle(lights, arguments, matrix);
}

} // namespace shadowproof
