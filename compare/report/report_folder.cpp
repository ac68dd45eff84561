#include "compare/report/report.h"
#include "compare/report/report_data.h"
#include "compare/report/report_page.h"
#include "compare/report/report_pictures.h"

namespace shadowproof {

ReportFolder::ReportFolder(const std::filesystem::path& folder, CutOff cut_off)
    : files_(folder, {page_name, results_name, results_script_name}, cut_off),
      memo_(std::make_unique<Memo>()), shared_(std::make_unique<SharedFiles>()) {}

void ReportFolder::add_scene(const SceneResult& scene) const {
    const auto lock = hold_unfinished();
    memo_->forget();
    write_scene(scene, {files_});
}

void ReportFolder::add_cell(const SceneResult& scene, Cell& cell, int threads) const {
    const auto lock = hold_unfinished();
    write_cell(scene, cell, {files_}, *memo_, shared_.get(), threads);
}

void ReportFolder::recall_cell(const SceneResult& scene, const Cell& cell) const {
    if (!cell.error.empty()) return;
    for (const char* const kind : picture_kinds) {
        const std::string path = own_path(scene, cell, kind);
        if (picture_path(scene, cell, kind) == path) shared_->place_of(path, files_.bytes_of(path));
    }
    const std::string path = script_path(scene, cell);
    shared_->shared(path, files_.bytes_of(path));
}

void ReportFolder::add_file(const std::string& name, std::string_view bytes) const {
    const auto lock = hold_unfinished();
    files_.add(name, bytes);
}

std::string ReportFolder::add_picture(const std::string& name, std::string_view bytes) const {
    std::string place = shared_->place_of(name, bytes);
    if (place == name) add_file(name, bytes);
    return place;
}

void ReportFolder::add_script(const std::string& name, const std::string& script) const {
    add_file(name, shared_->shared(name, script));
}

void ReportFolder::add_requested(const std::string& name, std::string_view bytes) {
    const auto lock = hold_unfinished();
    files_.add_requested(name, bytes);
}

GrowingResults ReportFolder::grow_results(nlohmann::ordered_json head,
                                          const std::optional<std::string>& requested) {
    return {files_, std::move(head), requested};
}

void ReportFolder::finish(const Report& report) {
    const auto lock = hold_unfinished();
    const std::string results = to_json(report);
    files_.add(results_name, results);
    files_.add(results_script_name, results_script(results));
    finish();
}

void ReportFolder::finish() {
    const auto lock = hold_unfinished();
    files_.add(page_name, report_page());
    files_.finish();
}

} // namespace shadowproof
