#include "compare/command/bench/pictures.h"

#include "compare/output/manifest.h"
#include "compare/output/unfinished.h"
#include "compare/report/report_data.h"
#include "compare/report/report_page.h"
#include "compare/report/report_pictures.h"
#include "scenes/error.h"
#include "scenes/load/file_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace shadowproof {

namespace fs = std::filesystem;

namespace {

std::string name_of(const std::string& scene, const BenchSettings& settings) {
    std::string name = scene;
    for (const auto& [setting, value] : settings) name += "-" + setting + "-" + value;
    return name;
}

/// What of a scene is in results.json, without its pictures.
SceneResult without_pictures(SceneResult& scene) {
    GroundTruth truth = std::move(scene.truth);
    Image<glm::dvec3> color = std::move(scene.color);
    scene.truth = {};
    scene.color = {};
    SceneResult rest = scene;
    rest.truth.statistics = truth.statistics;
    scene.truth = std::move(truth);
    scene.color = std::move(color);
    return rest;
}

} // namespace

std::vector<std::string> fixed_pictures() {
    std::vector<std::string> files;
    for (const char* name : {page_name, results_name, results_script_name})
        files.push_back(std::string(pictures_folder) + "/" + name);
    return files;
}

BenchPictures::BenchPictures(const ReplacedFolder& folder)
    : part_{folder, std::string(pictures_folder) + "/"} {}

void BenchPictures::begin(SceneResult& scene) {
    scene_ = &scene;
    begun_ = scene.name;
    group_of_.clear();
}

std::size_t BenchPictures::begin_group(const BenchSettings& settings) {
    const std::string wanted = name_of(begun_, settings);
    scene_->name = wanted;
    const auto is_taken = [&](const SceneResult& other) {
        return folder_of(other) == folder_of(*scene_);
    };
    for (int number = 2; std::ranges::any_of(groups_, is_taken); ++number)
        scene_->name = fmt::format("{}-{}", wanted, number);
    write_scene(*scene_, part_);
    groups_.push_back(without_pictures(*scene_));
    return groups_.size() - 1;
}

std::string BenchPictures::add(const BenchSettings& settings, Cell cell, int threads) {
    const auto lock = hold_unfinished();
    try {
        return write(settings, std::move(cell), threads);
    } catch (const std::bad_alloc&) {
        return {};
    } catch (const Error& error) {
        throw std::runtime_error(error.what());
    }
}

std::string BenchPictures::write(const BenchSettings& settings, Cell cell, int threads) {
    const auto found = group_of_.find(settings);
    const std::size_t number = found != group_of_.end() ? found->second : begin_group(settings);
    group_of_.emplace(settings, number);
    SceneResult& group = groups_[number];
    scene_->name = group.name;
    write_cell(*scene_, cell, part_, threads);
    cell.frame = {};
    cell.evidence.reset();
    cell.comparison.cause = {};
    cell.comparison.also = {};
    cell.comparison.evidence_miss = {};
    if (cell.comparison.colors) {
        cell.comparison.colors->error = {};
        cell.comparison.colors->verdict = {};
    }
    group.cells.push_back(std::move(cell));
    return part_.below + page_name + "#" + folder_of(group) + "/" + group.cells.back().technique;
}

void BenchPictures::finish(const BenchRun& run) {
    if (groups_.empty()) return;
    const auto lock = hold_unfinished();
    Report report;
    report.version = run.version;
    report.gl = run.gl;
    report.embree = run.embree;
    report.arguments = run.arguments;
    report.scenes = std::move(groups_);
    report.passed = std::ranges::none_of(report.scenes, [&](const SceneResult& scene) {
        return std::ranges::any_of(scene.cells,
                                   [&](const Cell& cell) { return fails(cell, report.gate); });
    });
    const std::string results = to_json(report);
    part_.add(page_name, report_page());
    part_.add(results_name, results);
    part_.add(results_script_name, results_script(results));
}

void take_over_pictures(const std::string& from, BenchRun& run, const ReplacedFolder& folder,
                        bool wanted) {
    const fs::path given = fs::absolute(from);
    const fs::path older = given.filename() == results_name ? given.parent_path() : given;
    const FolderPart part{folder, std::string(pictures_folder) + "/"};
    const MemoryAccount account;
    std::set<std::string> taken;
    const Manifest written =
        wanted && fs::is_directory(older) ? read_manifest(older).value_or(Manifest()) : Manifest();
    for (const auto& [name, fingerprint] : written) {
        if (!name.starts_with(part.below) || name == part.below + page_name) continue;
        std::error_code failure;
        if (!fs::is_regular_file(fs::symlink_status(older / name, failure))) continue;
        const FileBytes bytes = read_bytes(older / name, Place((older / name).string()), account);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (fingerprint_of(text) != fingerprint) continue;
        folder.add(name, text);
        taken.insert(name.substr(part.below.size()));
    }
    const bool whole = taken.contains(results_name) && taken.contains(results_script_name);
    if (whole) part.add(page_name, report_page());
    const std::string page = part.below + page_name + "#";
    for (BenchPoint& point : run.points)
        if (!whole || point.pictures.size() < page.size() ||
            !taken.contains(point.pictures.substr(page.size()) + "/cell.js"))
            point.pictures.clear();
}

} // namespace shadowproof
