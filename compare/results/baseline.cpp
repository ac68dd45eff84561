#include "compare/results/baseline.h"

#include "compare/json/blocks.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

/// The object of a list that has `value` as its `key`, or null.
const ResultsJson* find(const ResultsJson& list, std::string_view key, const std::string& value) {
    for (const ResultsJson& each : list)
        if (each.contains(key) && each[std::string(key)] == value) return &each;
    return nullptr;
}

const ResultsJson* find_scene(const ResultsJson& results, const std::string& name) {
    return find(results.at("scenes"), "name", name);
}

bool could_be_tried(const ResultsJson& thing) {
    return !thing.contains("error");
}

std::string words_of(const ResultsJson& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

void note_changed(std::vector<std::string>& notes, std::string_view what, const ResultsJson& was,
                  const ResultsJson& now) {
    if (was != now)
        notes.push_back(fmt::format("{} is {}, and was {}", what, words_of(now), words_of(was)));
}

void note_scene(std::vector<std::string>& notes, const ResultsJson& was, const ResultsJson& now,
                bool is_whole) {
    if (!could_be_tried(now)) return;
    const std::string name = words_of(now.at("name"));
    if (!could_be_tried(was)) {
        notes.push_back(fmt::format("{} could not be tried then", name));
        return;
    }
    if (was.at("digest") != now.at("digest")) {
        notes.push_back(fmt::format("{} has another content, camera, light or size (digest {}, and "
                                    "was {}): its pixels cannot be compared",
                                    name, words_of(now.at("digest")), words_of(was.at("digest"))));
        return;
    }
    for (const ResultsJson& cell : now.at("techniques")) {
        const std::string technique = words_of(cell.at("name"));
        const ResultsJson* old = find(was.at("techniques"), "name", technique);
        if (old == nullptr)
            notes.push_back(fmt::format("{} on {} is new", technique, name));
        else if (!could_be_tried(*old))
            notes.push_back(fmt::format("{} on {} could not run then", technique, name));
    }
    if (!is_whole) return;
    for (const ResultsJson& old : was.at("techniques"))
        if (const std::string technique = words_of(old.at("name"));
            find(now.at("techniques"), "name", technique) == nullptr)
            notes.push_back(fmt::format("{} on {} was not tried now", technique, name));
}

/// Of a scene or a cell.
ResultsJson outline(const std::string& name, bool could_be_tried) {
    ResultsJson json{{"name", name}};
    if (!could_be_tried) json["error"] = true;
    return json;
}

/// What a picture's unexplained pixels are: its best hypothesis.
std::string diagnosed(const ResultsJson& cell) {
    const auto diagnosis = cell.find("diagnosis");
    if (diagnosis == cell.end() || diagnosis->empty()) return {};
    return words_of(diagnosis->front().at("hypothesis"));
}

} // namespace

std::string accepted_name(const ResultsJson& cell, Cause cause) {
    return cause == Cause::unexplained ? diagnosed(cell) : std::string(name_of(cause));
}

void compare_with(const ResultsFile& baseline, const SceneResult& scene, Cell& cell) {
    const ResultsJson* was = find_scene(baseline.json, scene.name);
    if (was == nullptr || !could_be_tried(*was) || !scene.error.empty() || !cell.error.empty() ||
        was->at("digest") != scene.digest)
        return;
    const ResultsJson* old = find((*was)["techniques"], "name", cell.technique);
    if (old == nullptr || !could_be_tried(*old)) return;
    Image<std::uint8_t> causes(scene.width, scene.height);
    const auto bytes = unpacked((*old)["cause_map"].get<std::string>(), causes.pixels.size());
    const bool known = bytes && std::all_of(bytes->begin(), bytes->end(), [](std::uint8_t value) {
                           return value == no_difference || value < all_causes.size();
                       });
    if (!known)
        throw Error(baseline.path.string(),
                    fmt::format("the cause map of {} on {} is damaged", cell.technique, scene.name),
                    "make the baseline anew");
    causes.pixels = *bytes;
    cell.since = changes_since(causes, cell.comparison.cause);
    if (!baseline.json.contains("accepted")) return;
    const ResultsJson& reasons = baseline.json["accepted"]["reasons"];
    for (const CauseWords& words : all_causes)
        if (const std::string name = accepted_name(*old, words.cause); reasons.contains(name))
            cell.accepted.push_back({words.cause, reasons[name].get<std::string>()});
}

ResultsJson outline_of(const ResultsJson& results) {
    ResultsJson json{{"version", results.at("version")},
                     {"embree", results.at("embree")},
                     {"gl", results.at("gl")},
                     {"scenes", ResultsJson::array()}};
    for (const ResultsJson& scene : results.at("scenes")) {
        ResultsJson& one =
            json["scenes"].emplace_back(outline(words_of(scene.at("name")), could_be_tried(scene)));
        if (!could_be_tried(scene)) continue;
        one["digest"] = scene.at("digest");
        one["techniques"] = ResultsJson::array();
        for (const ResultsJson& cell : scene.at("techniques"))
            one["techniques"].push_back(outline(words_of(cell.at("name")), could_be_tried(cell)));
    }
    return json;
}

ResultsJson outline_of(const Report& report) {
    ResultsJson json{{"version", report.version},
                     {"embree", report.embree},
                     {"gl", {{"version", report.gl.version}, {"renderer", report.gl.renderer}}},
                     {"scenes", ResultsJson::array()}};
    for (const SceneResult& scene : report.scenes) {
        ResultsJson& one = json["scenes"].emplace_back(outline(scene.name, scene.error.empty()));
        one["digest"] = scene.digest;
        one["techniques"] = ResultsJson::array();
        for (const Cell& cell : scene.cells)
            one["techniques"].push_back(outline(cell.technique, cell.error.empty()));
    }
    return json;
}

std::vector<std::string> notes_on(const ResultsJson& was, const ResultsJson& now, bool is_whole) {
    std::vector<std::string> notes;
    note_changed(notes, "shadowproof", was.at("version"), now.at("version"));
    note_changed(notes, "Embree", was.at("embree"), now.at("embree"));
    note_changed(notes, "OpenGL", was.at("gl").at("version"), now.at("gl").at("version"));
    note_changed(notes, "the renderer", was.at("gl").at("renderer"), now.at("gl").at("renderer"));
    for (const ResultsJson& scene : now.at("scenes")) {
        const ResultsJson* old = find_scene(was, words_of(scene.at("name")));
        if (old != nullptr)
            note_scene(notes, *old, scene, is_whole);
        else
            notes.push_back(fmt::format("{} is new", words_of(scene.at("name"))));
    }
    if (!is_whole) return notes;
    for (const ResultsJson& old : was.at("scenes"))
        if (const std::string name = words_of(old.at("name")); find_scene(now, name) == nullptr)
            notes.push_back(name + " was not tried now");
    return notes;
}

} // namespace shadowproof
