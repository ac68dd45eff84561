#include "compare/results/merge.h"

#include "compare/results/baseline.h"
#include "compare/results/results_check.h"
#include "compare/verdict.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
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

bool is_shard(const IndexedResults& run) {
    return run.head.contains("shard");
}

std::uint64_t number_of(const IndexedResults& run, const char* member = "number") {
    return run.head.at("shard").at(member).get<std::uint64_t>();
}

std::string words_of(const IndexedResults& run) {
    return fmt::format("shard {}/{}", number_of(run), number_of(run, "of"));
}

/// Puts shards in order, before other runs. Throws Error where they are not all of one run.
void order_shards(std::vector<IndexedResults>& runs) {
    std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) {
        if (!is_shard(a) || !is_shard(b)) return is_shard(a) && !is_shard(b);
        return number_of(a) < number_of(b);
    });
    if (!is_shard(runs.front())) return;
    const IndexedResults& first = runs.front();
    std::uint64_t expected = 1;
    for (const IndexedResults& run : runs) {
        if (!is_shard(run)) break;
        for (const char* member : {"of", "run"})
            if (run.head.at("shard").at(member) != first.head.at("shard").at(member))
                throw Error(run.path.string(),
                            fmt::format("is {} of another run than {}, {}", words_of(run),
                                        first.path.string(), words_of(first)),
                            "join the shards of one command, with the same scenes, techniques and "
                            "settings");
        if (number_of(run) < expected)
            throw Error(run.path.string(),
                        fmt::format("is {}, which was given already", words_of(run)),
                        "name each shard once");
        if (number_of(run) > expected) break;
        ++expected;
    }
    if (const std::uint64_t of = number_of(first, "of"); expected <= of)
        throw Error(
            first.path.string(),
            fmt::format("is {}, and shard {}/{} is not there", words_of(first), expected, of),
            "name the reports of all shards; one that was cut off goes on with --resume");
}

/// The joined results while they grow.
struct Joining {
    /// Beside a scene of the joined results.
    struct Beside {
        bool joined = false;                           ///< with cells of later runs
        std::map<std::string, std::size_t> tried_by{}; ///< technique: run
    };

    const std::vector<IndexedResults>& runs;
    Merged merged;
    std::vector<Beside> beside{};
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
        const auto [tried, is_new] = joining.beside[index].tried_by.emplace(cells[i].name, run);
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
        scenes.push_back({scene, run, number, {}});
        joining.beside.emplace_back();
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
        joining.beside[index].joined = true;
        Json& stopped = scenes[index].head.at("no_longer_provoked");
        stopped = joined_causes(stopped, scene.at("no_longer_provoked"));
    } else {
        index = add();
        joining.by_name[name].push_back(index);
        scenes[index].head["folder"] = free_folder(joining, scene.at("folder").get<std::string>());
    }
    add_cells(joining, index, run, number);
}

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

std::vector<Lights> lights_of(Joining& joining, const Matrix& matrix) {
    std::vector<Lights> all;
    std::vector<MergedScene>& scenes = joining.merged.scenes;
    for (std::size_t begin = 0; begin < scenes.size();) {
        Lights lights{{}, bundled_scene(scenes[begin], matrix), joining.beside[begin].joined};
        std::size_t end = begin + 1;
        for (; !lights.bundled.empty() && end < scenes.size() &&
               bundled_scene(scenes[end], matrix) == lights.bundled;
             ++end)
            lights.joined =
                lights.joined || joining.beside[end].joined || scenes[end].run != scenes[begin].run;
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

/// In the order of the registry: that of the runs may be any.
void sort_cells(const Lights& lights, const Matrix& matrix) {
    const auto place = [&](const MergedCell& cell) {
        return std::ranges::find(matrix.techniques, cell.what.name, &KnownTechnique::name);
    };
    for (MergedScene& scene : lights.scenes)
        std::stable_sort(
            scene.cells.begin(), scene.cells.end(),
            [&](const MergedCell& a, const MergedCell& b) { return place(a) < place(b); });
}

void settle_joined(const Lights& lights, const Json& arguments, const Matrix& matrix) {
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
    const bool are_shards = std::ranges::all_of(runs, is_shard); // in their run's order
    for (const Lights& lights : lights_of(joining, matrix)) {
        if (!lights.joined) continue;
        if (!are_shards) sort_cells(lights, matrix);
        settle_joined(lights, results.at("arguments"), matrix);
    }
    if (is_shard(runs.front())) end_shards(joining.merged);
    results["passed"] =
        results.at("passed") == true && std::ranges::none_of(joining.merged.scenes, fails_the_run);
    return std::move(joining.merged);
}

Merged alone(const IndexedResults& run) {
    Merged merged{run.head, {}};
    for (std::size_t i = 0; i < run.scenes.size(); ++i) {
        MergedScene& scene = merged.scenes.emplace_back(MergedScene{run.scenes[i].head, 0, i, {}});
        for (std::size_t k = 0; k < run.scenes[i].cells.size(); ++k)
            scene.cells.push_back({0, i, k, run.scenes[i].cells[k]});
    }
    return merged;
}

} // namespace shadowproof
