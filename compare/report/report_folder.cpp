#include "compare/report/report.h"
#include "compare/report/report_data.h"
#include "compare/report/report_page.h"
#include "compare/report/report_pictures.h"
#include "compare/report/shared_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shadowproof {

ReportFolder::ReportFolder(const std::filesystem::path& folder)
    : files_(folder, {page_name, results_name, results_script_name}),
      memo_(std::make_unique<Memo>()) {}

void ReportFolder::add_scene(const SceneResult& scene) const {
    const auto lock = hold_unfinished();
    memo_->forget();
    write_scene(scene, {files_});
}

void ReportFolder::add_cell(const SceneResult& scene, Cell& cell, int threads) const {
    const auto lock = hold_unfinished();
    write_cell(scene, cell, {files_}, *memo_, threads);
}

void ReportFolder::add_file(const std::string& name, std::string_view bytes) const {
    const auto lock = hold_unfinished();
    files_.add(name, bytes);
}

void ReportFolder::add_requested(const std::string& name, std::string_view bytes) {
    const auto lock = hold_unfinished();
    files_.add_requested(name, bytes);
}

void ReportFolder::share(Report& report) const {
    const auto lock = hold_unfinished();
    for (SceneResult& scene : report.scenes) {
        if (!scene.error.empty()) continue;
        const std::string folder = folder_of(scene);
        SceneFiles shared{folder, {}};
        for (Cell& cell : scene.cells) {
            if (!cell.error.empty()) continue;
            CellFiles& files = shared.cells.emplace_back();
            files.script = fmt::format("{}/{}/cell.js", folder, cell.technique);
            for (const std::string& kind : picture_kinds(cell)) {
                const std::string path = picture_path(scene, cell, kind);
                files.pictures.push_back(&(cell.same_pictures[kind] = path));
            }
        }
        share_files(files_, shared);
    }
}

void ReportFolder::share(nlohmann::ordered_json& results) const {
    const auto lock = hold_unfinished();
    for (auto& scene : results.at("scenes")) {
        if (scene.contains("error")) continue;
        SceneFiles shared{scene.at("folder").get<std::string>(), {}};
        for (auto& cell : scene.at("techniques")) {
            if (cell.contains("error")) continue;
            CellFiles& files = shared.cells.emplace_back();
            files.script = fmt::format("{}/{}/cell.js", shared.folder,
                                       cell.at("name").get_ref<const std::string&>());
            for (auto& path : cell.at("images"))
                files.pictures.push_back(&path.get_ref<std::string&>());
        }
        share_files(files_, shared);
    }
}

void ReportFolder::finish(const Report& report) {
    finish(to_json(report));
}

void ReportFolder::finish(const std::string& results) {
    const auto lock = hold_unfinished();
    files_.add(page_name, report_page());
    files_.add(results_name, results);
    files_.add(results_script_name, results_script(results));
    files_.finish();
}

} // namespace shadowproof
