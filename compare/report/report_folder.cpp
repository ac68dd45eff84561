#include "compare/report/report.h"
#include "compare/report/report_data.h"
#include "compare/report/report_page.h"
#include "compare/report/report_pictures.h"

namespace shadowproof {

ReportFolder::ReportFolder(const std::filesystem::path& folder)
    : files_(folder, {page_name, results_name, results_script_name}) {}

void ReportFolder::add_scene(const SceneResult& scene) const {
    const auto lock = hold_unfinished();
    write_scene(scene, {files_});
}

void ReportFolder::add_cell(const SceneResult& scene, Cell& cell, int threads) const {
    const auto lock = hold_unfinished();
    write_cell(scene, cell, {files_}, threads);
}

void ReportFolder::add_file(const std::string& name, std::string_view bytes) const {
    const auto lock = hold_unfinished();
    files_.add(name, bytes);
}

void ReportFolder::add_requested(const std::string& name, std::string_view bytes) {
    const auto lock = hold_unfinished();
    files_.add_requested(name, bytes);
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
