#include "compare/results/merge.h"

#include "compare/results/results_check.h"
#include "compare/verdict.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace shadowproof {

namespace {

using Json = ResultsJson;

/// Where two values differ: a JSON pointer, and both values there.
struct Difference {
    std::string pointer;
    std::string first;
    std::string second;
};

/// The first difference of two values, object by object; `apart` holds pointers that may differ.
std::optional<Difference> difference(const Json& a, const Json& b, const std::string& pointer,
                                     const std::set<std::string>& apart) {
    if (a == b || apart.contains(pointer)) return std::nullopt;
    if (!a.is_object() || !b.is_object()) return Difference{pointer, shown(a), shown(b)};
    for (const auto& [name, value] : a.items()) {
        const std::string at = pointer + "/" + name;
        if (apart.contains(at)) continue;
        if (!b.contains(name)) return Difference{at, shown(value), "missing"};
        if (auto found = difference(value, b.at(name), at, apart)) return found;
    }
    for (const auto& [name, value] : b.items()) {
        const std::string at = pointer + "/" + name;
        if (!a.contains(name) && !apart.contains(at))
            return Difference{at, "missing", shown(value)};
    }
    return std::nullopt;
}

/// `in`: where the pointer starts in the second file.
[[noreturn]] void refuse(const ResultsFile& first, const ResultsFile& second, const std::string& in,
                         const Difference& difference, const char* remedy) {
    throw Error(second.path.string(),
                fmt::format("{}{} is {}, but {} in {}", in, difference.pointer, difference.second,
                            difference.first, first.path.string()),
                remedy);
}

/// The words of a run's command without those of its gate, each of which takes a value.
Json without_gate(const Json& arguments) {
    Json words = Json::array();
    for (std::size_t i = 0; i < arguments.size(); ++i)
        if (arguments[i] == "--gate" || arguments[i] == "--allow")
            ++i;
        else
            words.push_back(arguments[i]);
    return words;
}

void check_same_settings(const ResultsFile& first, const ResultsFile& second) {
    // Notes on a baseline concern the scenes that a run tried; a gate judges what a run has found.
    const std::set<std::string> apart{"/passed",         "/ms",        "/report_ms", "/scenes",
                                      "/baseline/notes", "/arguments", "/gate",      "/allow"};
    const char* const remedy = "join runs of one version on one driver with the same settings";
    if (const auto found = difference(first.json, second.json, "", apart))
        refuse(first, second, "", *found, remedy);
    if (const auto found = difference(without_gate(first.json.at("arguments")),
                                      without_gate(second.json.at("arguments")), "/arguments", {}))
        refuse(first, second, "", *found, remedy);
}

/// The joined results while they grow.
struct Joining {
    /// A scene of the joined results, and the run that it is from.
    struct Scene {
        std::size_t run = 0;                           ///< that brought it
        bool joined = false;                           ///< with cells of later runs
        std::map<std::string, std::size_t> tried_by{}; ///< technique: run
    };

    const std::vector<ResultsFile>& runs;
    Merged merged;
    std::vector<Scene> scenes{}; ///< beside those of the results

    Json& scenes_json() { return merged.results.at("scenes"); }
};

bool folder_is_taken(Joining& joining, const std::string& folder) {
    const Json& scenes = joining.scenes_json();
    return std::any_of(scenes.begin(), scenes.end(),
                       [&](const Json& scene) { return scene.value("folder", "") == folder; });
}

std::string free_folder(Joining& joining, const std::string& wanted) {
    std::string folder = wanted;
    for (int number = 2; folder_is_taken(joining, folder); ++number)
        folder = fmt::format("{}-{}", wanted, number);
    return folder;
}

struct Move {
    const ResultsFile& run;
    std::string from; ///< the scene's folder there
    std::string to;   ///< and in the joined report
};

/// Pictures of a scene or a cell: their paths, and the files to take over. Each has a file of its
/// own again, also where it was another cell's. `below`: "/zpass" of a cell, nothing of a scene.
void move_pictures(Joining& joining, Json& images, const std::string& below, const Json& scene,
                   const Move& move) {
    for (auto& [name, path] : images.items()) {
        const auto was = path.get<std::string>();
        path = fmt::format("{}{}/{}.png", move.to, below, name);
        joining.merged.files.push_back({.from = move.run.path.parent_path() / was,
                                        .to = path.get<std::string>(),
                                        .width = scene.at("width").get<std::uint64_t>(),
                                        .height = scene.at("height").get<std::uint64_t>(),
                                        .opening = {},
                                        .new_opening = {}});
    }
}

/// `below`: "/zpass" of a cell, nothing of a scene.
void move_script(Joining& joining, const char* function, const std::string& below,
                 const Move& move) {
    const auto opening = [&](const std::string& folder) {
        return fmt::format("shadowproof.{}(\"{}{}\", ", function, folder, below);
    };
    const std::string file = fmt::format("{}/{}.js", below, function);
    joining.merged.files.push_back({.from = move.run.path.parent_path() / (move.from + file),
                                    .to = move.to + file,
                                    .opening = opening(move.from),
                                    .new_opening = opening(move.to)});
}

bool has_same_gate(const Json& a, const Json& b) {
    return a.at("gate") == b.at("gate") && a.at("allow") == b.at("allow");
}

/// A cell names the gate by which it was judged where it is not the one of the joined results.
void keep_gate(Json& cell, const Json& run, const Json& joined) {
    if (could_not_run(cell)) return;
    if (!cell.contains("gate")) {
        cell["gate"] = run.at("gate");
        cell["allow"] = run.at("allow");
    }
    if (!has_same_gate(cell, joined)) return;
    cell.erase("gate");
    cell.erase("allow");
}

void add_cell(Joining& joining, std::size_t index, Json cell, std::size_t run, const Move& move) {
    Json& scene = joining.scenes_json().at(index);
    const auto technique = cell.at("name").get<std::string>();
    const auto [tried, is_new] = joining.scenes[index].tried_by.emplace(technique, run);
    if (!is_new)
        throw Error(move.run.path.string(),
                    fmt::format("has the cell {} of {}, which {} has too", technique,
                                shown(scene.at("name")), joining.runs[tried->second].path.string()),
                    "join runs of different scenes or techniques");
    if (!could_not_run(cell)) {
        move_pictures(joining, cell.at("images"), "/" + technique, scene, move);
        move_script(joining, "cell", "/" + technique, move);
    }
    keep_gate(cell, move.run.json, joining.merged.results);
    scene.at("techniques").push_back(std::move(cell));
}

/// The same scene by an earlier run, by its file, else by its content. Where there are only others
/// of that name, the first of them.
std::optional<std::size_t> earlier(Joining& joining, const Json& scene, std::size_t run) {
    std::optional<std::size_t> same_name;
    std::optional<std::size_t> same_content;
    for (std::size_t i = 0; i < joining.scenes.size(); ++i) {
        const Json& other = joining.scenes_json().at(i);
        if (joining.scenes[i].run == run || could_not_run(other)) continue;
        if (other.at("name") != scene.at("name")) continue;
        if (other.at("file") == scene.at("file")) return i;
        if (!same_content && other.at("digest") == scene.at("digest")) same_content = i;
        if (!same_name) same_name = i;
    }
    return same_content ? same_content : same_name;
}

/// Scenes of one name are one scene, wherever their file lay.
void check_same_scene(const Joining& joining, const Json& first, std::size_t first_run,
                      const Json& second, std::size_t run, const std::string& in) {
    const std::set<std::string> apart{"/file",
                                      "/folder",
                                      "/images",
                                      "/reference/ms",
                                      "/reference/build_ms",
                                      "/techniques",
                                      "/no_longer_provoked"};
    if (const auto found = difference(first, second, "", apart))
        refuse(joining.runs[first_run], joining.runs[run],
               fmt::format("{} (scene {})", in, shown(second.at("name"))), *found,
               "join runs of the same scene and size, or give the scenes' files other names");
}

void add_unreadable(Joining& joining, const Json& scene, std::size_t run) {
    for (std::size_t i = 0; i < joining.scenes.size(); ++i)
        if (joining.scenes[i].run != run && joining.scenes_json().at(i) == scene) return;
    joining.scenes_json().push_back(scene);
    joining.scenes.push_back({.run = run});
}

/// "no_longer_provoked" of both, in the order of all_causes.
Json joined_causes(const Json& a, const Json& b) {
    Json joined = Json::array();
    const auto has = [](const Json& causes, std::string_view name) {
        return std::find(causes.begin(), causes.end(), name) != causes.end();
    };
    for (const CauseWords& words : all_causes)
        if (has(a, words.name) || has(b, words.name)) joined.push_back(words.name);
    return joined;
}

void add_scene(Joining& joining, Json scene, std::size_t run, const std::string& pointer) {
    if (could_not_run(scene)) return add_unreadable(joining, scene, run);
    Json cells = std::exchange(scene.at("techniques"), Json::array());
    Move move{joining.runs[run], scene.at("folder").get<std::string>(), {}};
    std::size_t index = joining.scenes.size();
    if (const auto same = earlier(joining, scene, run)) {
        index = *same;
        Json& first = joining.scenes_json().at(index);
        check_same_scene(joining, first, joining.scenes[index].run, scene, run, pointer);
        joining.scenes[index].joined = true;
        move.to = first.at("folder").get<std::string>();
        first["no_longer_provoked"] =
            joined_causes(first.at("no_longer_provoked"), scene.at("no_longer_provoked"));
    } else {
        move.to = free_folder(joining, move.from);
        scene["folder"] = move.to;
        move_pictures(joining, scene.at("images"), "", scene, move);
        move_script(joining, "scene", "", move);
        joining.scenes_json().push_back(std::move(scene));
        joining.scenes.push_back({.run = run});
    }
    for (Json& cell : cells) add_cell(joining, index, std::move(cell), run, move);
}

bool shows(const Json& scene, std::string_view cause) {
    const Json& cells = scene.at("techniques");
    return std::any_of(cells.begin(), cells.end(), [&](const Json& cell) {
        return cell.contains("causes") && cell.at("causes").contains(cause);
    });
}

/// Whether a run has all techniques on a bundled scene's default picture: only such a run shows
/// what the scene stopped provoking. A technique that could not run may be the one that shows it.
bool is_whole(const Json& scene, const Json& arguments, const Matrix& matrix) {
    const auto name = scene.at("name").get<std::string>();
    const Json& cells = scene.at("techniques");
    const bool bundled =
        std::find(matrix.scenes.begin(), matrix.scenes.end(), name) != matrix.scenes.end();
    const bool changed = std::any_of(arguments.begin(), arguments.end(), [](const Json& word) {
        return word == "--size" || word == "--camera" || word == "--light" || word == "--time";
    });
    const auto ran_by_name = [&](const KnownTechnique& technique) {
        return !technique.on_every_scene ||
               std::any_of(cells.begin(), cells.end(), [&](const Json& cell) {
                   return cell.at("name") == technique.name && !could_not_run(cell) &&
                          cell.at("command").get<std::string>().starts_with(
                              fmt::format("shadowproof verify {} ", name));
               });
    };
    return bundled && !changed &&
           std::all_of(matrix.techniques.begin(), matrix.techniques.end(), ran_by_name);
}

Json stopped_provoking(const Json& scene, const Matrix& matrix) {
    std::vector<Cause> provokes;
    for (const Json& cause : scene.at("provokes"))
        provokes.push_back(*cause_named(cause.get_ref<const std::string&>()));
    std::vector<std::vector<Cause>> fails_at;
    for (const KnownTechnique& technique : matrix.techniques)
        if (technique.on_every_scene) fails_at.push_back(technique.fails_at);
    Json stopped = Json::array();
    for (const Cause cause : no_longer_provoked(
             provokes, fails_at, [&](Cause shown) { return shows(scene, name_of(shown)); }))
        stopped.push_back(name_of(cause));
    return stopped;
}

void settle_joined(Json& scene, const Json& arguments, const Matrix& matrix) {
    const auto place = [&](const Json& cell) {
        const auto& known = matrix.techniques;
        return std::find_if(known.begin(), known.end(), [&](const KnownTechnique& technique) {
            return technique.name == cell.at("name");
        });
    };
    Json& cells = scene.at("techniques");
    std::stable_sort(cells.begin(), cells.end(),
                     [&](const Json& a, const Json& b) { return place(a) < place(b); });
    if (is_whole(scene, arguments, matrix)) {
        scene["no_longer_provoked"] = stopped_provoking(scene, matrix);
        return;
    }
    Json still = Json::array();
    for (const Json& cause : scene.at("no_longer_provoked"))
        if (!shows(scene, cause.get<std::string>())) still.push_back(cause);
    scene["no_longer_provoked"] = still;
}

/// What a run has beside its scenes.
void add_run(Json& results, const Json& run) {
    for (const char* time : {"ms", "report_ms"})
        results[time] = results.at(time).get<double>() + run.at(time).get<double>();
    results["passed"] = results.at("passed") == true && run.at("passed") == true;
    if (!has_same_gate(results, run)) results["arguments"] = without_gate(results.at("arguments"));
    if (!results.contains("baseline") || !run.at("baseline").contains("notes")) return;
    Json& notes = results.at("baseline")["notes"];
    for (const Json& note : run.at("baseline").at("notes"))
        if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

} // namespace

Merged merge(const std::vector<ResultsFile>& runs, const Matrix& matrix) {
    Joining joining{runs, {runs.front().json, {}}};
    Json& results = joining.merged.results;
    results["scenes"] = Json::array();
    for (std::size_t run = 0; run < runs.size(); ++run) {
        if (run > 0) {
            check_same_settings(runs.front(), runs[run]);
            add_run(results, runs[run].json);
        }
        const Json& scenes = runs[run].json.at("scenes");
        for (std::size_t i = 0; i < scenes.size(); ++i)
            add_scene(joining, scenes.at(i), run, fmt::format("/scenes/{}", i));
    }
    Json& scenes = results.at("scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i)
        if (joining.scenes[i].joined) settle_joined(scenes.at(i), results.at("arguments"), matrix);
    results["passed"] =
        results.at("passed") == true && std::none_of(scenes.begin(), scenes.end(), scene_fails);
    return joining.merged;
}

} // namespace shadowproof
