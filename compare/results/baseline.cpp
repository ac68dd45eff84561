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

const ResultsJson* find_scene(const ResultsFile& baseline, const SceneResult& scene) {
    return find(baseline.json["scenes"], "name", scene.name);
}

bool could_be_tried(const ResultsJson& thing) {
    return !thing.contains("error");
}

bool same_content(const ResultsJson& was, const SceneResult& scene) {
    return could_be_tried(was) && scene.error.empty() && was["digest"] == scene.digest;
}

std::string words_of(const ResultsJson& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

void note_changed(std::vector<std::string>& notes, std::string_view what, const ResultsJson& was,
                  const ResultsJson& now) {
    if (was != now)
        notes.push_back(fmt::format("{} is {}, and was {}", what, words_of(now), words_of(was)));
}

void note_scene(std::vector<std::string>& notes, const ResultsJson& was, const SceneResult& scene) {
    if (!scene.error.empty()) return;
    if (!could_be_tried(was)) {
        notes.push_back(fmt::format("{} could not be tried then", scene.name));
        return;
    }
    if (!same_content(was, scene)) {
        notes.push_back(fmt::format("{} has another content, camera, light or size (digest {}, and "
                                    "was {}): its pixels cannot be compared",
                                    scene.name, scene.digest, words_of(was["digest"])));
        return;
    }
    for (const Cell& cell : scene.cells) {
        const ResultsJson* old = find(was["techniques"], "name", cell.technique);
        if (old == nullptr)
            notes.push_back(fmt::format("{} on {} is new", cell.technique, scene.name));
        else if (!could_be_tried(*old))
            notes.push_back(fmt::format("{} on {} could not run then", cell.technique, scene.name));
    }
    for (const ResultsJson& old : was["techniques"]) {
        const bool tried =
            std::any_of(scene.cells.begin(), scene.cells.end(),
                        [&](const Cell& cell) { return old["name"] == cell.technique; });
        if (!tried)
            notes.push_back(
                fmt::format("{} on {} was not tried now", words_of(old["name"]), scene.name));
    }
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
    const ResultsJson* was = find_scene(baseline, scene);
    if (was == nullptr || !same_content(*was, scene) || !cell.error.empty()) return;
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

std::vector<std::string> notes_on(const ResultsFile& baseline, const Report& report) {
    const ResultsJson& was = baseline.json;
    std::vector<std::string> notes;
    note_changed(notes, "shadowproof", was["version"], report.version);
    note_changed(notes, "Embree", was["embree"], report.embree);
    note_changed(notes, "OpenGL", was["gl"]["version"], report.gl.version);
    note_changed(notes, "the renderer", was["gl"]["renderer"], report.gl.renderer);
    for (const SceneResult& scene : report.scenes) {
        const ResultsJson* old = find_scene(baseline, scene);
        if (old != nullptr)
            note_scene(notes, *old, scene);
        else
            notes.push_back(fmt::format("{} is new", scene.name));
    }
    for (const ResultsJson& old : was["scenes"]) {
        const bool tried =
            std::any_of(report.scenes.begin(), report.scenes.end(),
                        [&](const SceneResult& scene) { return old["name"] == scene.name; });
        if (!tried) notes.push_back(words_of(old["name"]) + " was not tried now");
    }
    return notes;
}

} // namespace shadowproof
