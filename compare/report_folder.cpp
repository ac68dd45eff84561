#include "compare/report.h"
#include "compare/report_data.h"
#include "compare/report_page.h"
#include "compare/report_pictures.h"
#include "compare/unfinished.h"
#include "compare/write_file.h"
#include "scenes/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// What marks a folder as ours to replace: its results.json names our schema in its first bytes.
bool is_report(const fs::path& folder) {
    std::ifstream results(folder / "results.json", std::ios::binary);
    std::string head(64, '\0');
    results.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.find("\"shadowproof/results/") != std::string::npos;
}

/// A folder that stands in the report's place must be an older report, or empty.
void check_replaceable(const fs::path& folder) {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(folder, ignored))) return;
    if (fs::is_directory(folder, ignored) && (fs::is_empty(folder, ignored) || is_report(folder)))
        return;
    throw Error(folder.string(), "is there already and is not a report of this program",
                "remove it, or name another folder with --out");
}

/// "report/" and "report/." are the folder "report".
fs::path without_trailing_slash(const fs::path& folder) {
    fs::path normal = fs::absolute(folder).lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

[[noreturn]] void throw_unwritable(const fs::path& folder, const std::string& reason) {
    throw Error(folder.string(), "the report cannot be written (" + reason + ")",
                "name a folder that is writable with --out");
}

} // namespace

ReportFolder::ReportFolder(const fs::path& folder)
    : folder_(without_trailing_slash(folder)), beside_(folder_) {
    check_replaceable(folder_);
    const auto lock = hold_unfinished();
    std::error_code error;
    fs::remove_all(beside_.path(), error);
    fs::create_directories(beside_.path(), error);
    if (error) throw_unwritable(folder_, error.message());
}

void ReportFolder::add_scene(const SceneResult& scene) {
    const auto lock = hold_unfinished();
    try {
        write_scene(scene, beside_.path());
    } catch (const fs::filesystem_error& error) {
        throw_unwritable(folder_, error.code().message());
    }
}

void ReportFolder::add_cell(const SceneResult& scene, Cell& cell, int threads) {
    const auto lock = hold_unfinished();
    try {
        write_cell(scene, cell, beside_.path(), threads);
    } catch (const fs::filesystem_error& error) {
        throw_unwritable(folder_, error.code().message());
    }
}

void ReportFolder::finish(const Report& report) {
    finish(to_json(report));
}

void ReportFolder::finish(const std::string& results) {
    const auto lock = hold_unfinished();
    write_text(beside_.path() / "index.html", report_page());
    write_text(beside_.path() / "results.json", results);
    write_text(beside_.path() / "results.js", results_script(results));
    check_replaceable(folder_);
    try {
        // A folder that is not empty cannot be renamed over: the older one steps aside first, so
        // that there is a whole report at each moment but the one between two renames.
        const fs::path older = fmt::format("{}.older-{}", folder_.string(), getpid());
        const bool replaces = fs::exists(folder_);
        if (replaces) fs::rename(folder_, older);
        fs::rename(beside_.path(), folder_);
        if (replaces) fs::remove_all(older);
    } catch (const fs::filesystem_error& error) {
        throw_unwritable(folder_, error.code().message());
    }
}

} // namespace shadowproof
