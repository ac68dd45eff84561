#include "compare/results/merge.h"

#include "compare/results/baseline.h"
#include "compare/results/joined_lights.h"
#include "compare/results/results_check.h"
#include "compare/results/shard_order.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

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
[[noreturn]] void refuse(const IndexedResults& first, const IndexedResults& second,
                         const std::string& in, const Difference& difference, const char* remedy) {
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

void check_same_settings(const IndexedResults& first, const IndexedResults& second) {
    // Notes on a baseline concern the scenes that a run tried; a gate judges what a run has found.
    const std::set<std::string> apart{"/passed",         "/ms",        "/report_ms",
                                      "/scenes",         "/shard",     "/allow",
                                      "/baseline/notes", "/arguments", "/gate"};
    const char* const remedy = "join runs of one version on one driver with the same settings";
    if (const auto found = difference(first.head, second.head, "", apart))
        refuse(first, second, "", *found, remedy);
    if (const auto found = difference(without_gate(first.head.at("arguments")),
                                      without_gate(second.head.at("arguments")), "/arguments", {}))
        refuse(first, second, "", *found, remedy);
}

/// The joined results while they grow.
struct Joining {
    using Tried = std::map<std::string, std::size_t>; ///< technique: run

    const std::vector<IndexedResults>& runs;
    Merged merged;
    std::vector<Tried> tried_by{}; ///< of each scene
    std::set<std::string> folders{};
    std::map<std::string, std::vector<std::size_t>> by_name{};  ///< scenes that could be tried
    std::set<std::pair<std::string, std::string>> unreadable{}; ///< name and message
};

std::string free_folder(Joining& joining, const std::string& wanted) {
    std::string folder = wanted;
    for (int number = 2; !joining.folders.insert(folder).second; ++number)
        folder = fmt::format("{}-{}", wanted, number);
    return folder;
}

/// The same scene by an earlier run, by its file, else by its content. Where there are only others
/// of that name, the first of them.
std::optional<std::size_t> earlier(const Joining& joining, const Json& scene, std::size_t run) {
    const auto found = joining.by_name.find(scene.at("name").get<std::string>());
    if (found == joining.by_name.end()) return std::nullopt;
    std::optional<std::size_t> same_name;
    std::optional<std::size_t> same_content;
    for (const std::size_t i : found->second) {
        const MergedScene& other = joining.merged.scenes[i];
        if (other.run == run) continue;
        if (other.head.at("file") == scene.at("file")) return i;
        if (!same_content && other.head.at("digest") == scene.at("digest")) same_content = i;
        if (!same_name) same_name = i;
    }
    return same_content ? same_content : same_name;
}

/// Scenes of one name are one scene, wherever their file lay.
void check_same_scene(const Joining& joining, const MergedScene& first, const Json& second,
                      std::size_t run, const std::string& in) {
    const std::set<std::string> apart{"/file",
                                      "/folder",
                                      "/images",
                                      "/reference/ms",
                                      "/reference/build_ms",
                                      "/spent_ms",
                                      "/techniques",
                                      "/no_longer_provoked"};
    if (const auto found = difference(first.head, second, "", apart))
        refuse(joining.runs[first.run], joining.runs[run],
               fmt::format("{} (scene {})", in, shown(second.at("name"))), *found,
               "join runs of the same scene and size, or give the scenes' files other names");
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

void add_cells(Joining& joining, std::size_t index, std::size_t run, std::size_t number) {
    MergedScene& scene = joining.merged.scenes[index];
    const std::vector<IndexedCell>& cells = joining.runs[run].scenes[number].cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto [tried, is_new] = joining.tried_by[index].emplace(cells[i].name, run);
        if (!is_new)
            throw Error(joining.runs[run].path.string(),
                        fmt::format("has the cell {} of {}, which {} has too", cells[i].name,
                                    shown(scene.head.at("name")),
                                    joining.runs[tried->second].path.string()),
                        "join runs of different scenes or techniques");
        scene.cells.push_back({run, number, i, cells[i]});
    }
}

void add_scene(Joining& joining, std::size_t run, std::size_t number) {
    const Json& scene = joining.runs[run].scenes[number].head;
    const auto name = scene.at("name").get<std::string>();
    std::vector<MergedScene>& scenes = joining.merged.scenes;
    const auto add = [&] {
        scenes.push_back({.head = scene, .run = run, .scene = number, .cells = {}});
        joining.tried_by.emplace_back();
        return scenes.size() - 1;
    };
    if (could_not_run(scene)) {
        // Several runs may have failed at the same.
        if (joining.unreadable.emplace(name, scene.at("error").get<std::string>()).second) add();
        return;
    }
    std::size_t index = 0;
    if (const auto same = earlier(joining, scene, run)) {
        index = *same;
        check_same_scene(joining, scenes[index], scene, run, fmt::format("/scenes/{}", number));
        scenes[index].of_several_runs = true;
        Json& stopped = scenes[index].head.at("no_longer_provoked");
        stopped = joined_causes(stopped, scene.at("no_longer_provoked"));
    } else {
        index = add();
        joining.by_name[name].push_back(index);
        scenes[index].head["folder"] = free_folder(joining, scene.at("folder").get<std::string>());
    }
    add_cells(joining, index, run, number);
}

/// In the order of the registry: that of the runs may be any.
void sort_cells(MergedScene& scene, const Matrix& matrix) {
    const auto place = [&](const MergedCell& cell) {
        return std::ranges::find(matrix.techniques, cell.what.name, &KnownTechnique::name);
    };
    std::ranges::stable_sort(scene.cells, {}, place);
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

/// As outline_of has it.
Json outline_of(const Merged& merged) {
    Json outline = merged.head;
    for (const MergedScene& scene : merged.scenes) {
        Json& one = outline["scenes"].emplace_back(Json{{"name", scene.head.at("name")}});
        if (could_not_run(scene.head)) {
            one["error"] = true;
            continue;
        }
        one["digest"] = scene.head.at("digest");
        one["techniques"] = Json::array();
        for (const MergedCell& cell : scene.cells)
            one["techniques"].push_back({{"name", cell.what.name}});
    }
    return outline;
}

/// All shards are there: what they could not know by themselves is known now.
void end_shards(Merged& merged) {
    const Json shard = merged.head.at("shard");
    merged.head.erase("shard");
    if (shard.contains("baseline"))
        merged.head.at("baseline")["notes"] =
            notes_on(shard.at("baseline"), outline_of(merged), true);
}

bool fails_the_run(const MergedScene& scene) {
    return could_not_run(scene.head) || !scene.head.at("no_longer_provoked").empty() ||
           std::ranges::any_of(scene.cells, [](const MergedCell& cell) { return cell.what.fails; });
}

} // namespace

Merged merge(std::vector<IndexedResults>& runs, const Matrix& matrix) {
    order_shards(runs);
    Joining joining{runs, {runs.front().head, {}}};
    Json& results = joining.merged.head;
    for (std::size_t run = 0; run < runs.size(); ++run) {
        if (run > 0) {
            check_same_settings(runs.front(), runs[run]);
            add_run(results, runs[run].head);
        }
        for (std::size_t i = 0; i < runs[run].scenes.size(); ++i) add_scene(joining, run, i);
    }
    std::vector<MergedScene>& scenes = joining.merged.scenes;
    if (!std::ranges::all_of(runs, is_shard)) // which are in their run's order
        for (MergedScene& scene : scenes)
            if (scene.of_several_runs) sort_cells(scene, matrix);
    settle_what_is_provoked(scenes, results.at("arguments"), matrix);
    if (is_shard(runs.front())) end_shards(joining.merged);
    results["passed"] = results.at("passed") == true && std::ranges::none_of(scenes, fails_the_run);
    return std::move(joining.merged);
}

Merged alone(const IndexedResults& run) {
    Merged merged{run.head, {}};
    for (std::size_t i = 0; i < run.scenes.size(); ++i) {
        MergedScene& scene = merged.scenes.emplace_back(
            MergedScene{.head = run.scenes[i].head, .run = 0, .scene = i, .cells = {}});
        for (std::size_t k = 0; k < run.scenes[i].cells.size(); ++k)
            scene.cells.push_back({0, i, k, run.scenes[i].cells[k]});
    }
    return merged;
}

} // namespace shadowproof
