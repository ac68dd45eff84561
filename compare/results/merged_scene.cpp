#include "compare/results/merge.h"
#include "compare/results/results_check.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace shadowproof {

namespace {

using Json = ResultsJson;

/// The folder of a scene in the report of a run, and in the joined one.
struct Move {
    std::filesystem::path report;
    std::string from;
    std::string to;
};

/// What the names of its files begin with: "zpass." of a cell, nothing of a scene.
std::string prefix_of(const std::string& technique) {
    return technique.empty() ? "" : technique + ".";
}

/// Pictures of a scene or a cell. Each has a file of its own, also where it was another cell's.
/// `technique`: of a cell; of a scene empty.
void move_pictures(WholeScene& whole, Json& images, const std::string& technique,
                   const Move& move) {
    for (auto& [name, path] : images.items()) {
        const auto was = path.get<std::string>();
        path = fmt::format("{}/{}{}.png", move.to, prefix_of(technique), name);
        whole.files.push_back({.from = move.report / was,
                               .to = path.get<std::string>(),
                               .width = whole.json.at("width").get<std::uint64_t>(),
                               .height = whole.json.at("height").get<std::uint64_t>(),
                               .opening = {},
                               .new_opening = {},
                               .of_cell = !technique.empty(),
                               .place = technique.empty() ? nullptr : &path});
    }
}

/// `technique`: of a cell; of a scene empty.
void move_script(WholeScene& whole, const char* function, const std::string& technique,
                 const Move& move) {
    const auto opening = [&](const std::string& folder) {
        return fmt::format("shadowproof.{}(\"{}{}{}\", ", function, folder,
                           technique.empty() ? "" : "/", technique);
    };
    const std::string file = fmt::format("{}{}.js", prefix_of(technique), function);
    whole.files.push_back({.from = move.report / move.from / file,
                           .to = move.to + "/" + file,
                           .opening = opening(move.from),
                           .new_opening = opening(move.to),
                           .of_cell = !technique.empty()});
}

/// A cell names the gate by which it was judged where it is not the one of the joined results.
void keep_gate(Json& cell, const Json& run, const Json& joined) {
    if (could_not_run(cell)) return;
    if (!cell.contains("gate")) {
        cell["gate"] = run.at("gate");
        cell["allow"] = run.value("allow", Json::array());
    }
    if (!has_same_gate(cell, joined)) return;
    cell.erase("gate");
    cell.erase("allow");
}

} // namespace

WholeScene whole_scene(const Merged& merged, std::size_t index,
                       const std::vector<IndexedResults>& runs) {
    const MergedScene& scene = merged.scenes[index];
    WholeScene whole{scene.head, {}};
    if (could_not_run(scene.head)) return whole;
    std::map<std::pair<std::size_t, std::size_t>, Json> parts; // by run and scene
    const auto part = [&](std::size_t run, std::size_t number) -> Json& {
        const auto [place, is_new] = parts.try_emplace({run, number});
        if (is_new) place->second = runs[run].scene(number);
        return place->second;
    };
    const auto move_of = [&](std::size_t run, std::size_t number) {
        return Move{runs[run].path.parent_path(), part(run, number).at("folder").get<std::string>(),
                    scene.head.at("folder").get<std::string>()};
    };
    Json& cells = whole.json.at("techniques");
    for (const MergedCell& cell : scene.cells) {
        cells.push_back(std::move(part(cell.run, cell.scene).at("techniques").at(cell.cell)));
        keep_gate(cells.back(), runs[cell.run].head, merged.head);
    }
    const Move own = move_of(scene.run, scene.scene);
    move_pictures(whole, whole.json.at("images"), "", own);
    move_script(whole, "scene", "", own);
    for (std::size_t i = 0; i < scene.cells.size(); ++i) {
        const MergedCell& cell = scene.cells[i];
        if (could_not_run(cells.at(i))) continue;
        const Move move = move_of(cell.run, cell.scene);
        move_pictures(whole, cells.at(i).at("images"), cell.what.name, move);
        move_script(whole, "cell", cell.what.name, move);
    }
    return whole;
}

} // namespace shadowproof
