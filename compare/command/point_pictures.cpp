#include "compare/command/point_pictures.h"

#include "compare/output/unfinished.h"
#include "compare/report/report_data.h"
#include "compare/report/report_page.h"
#include "compare/report/report_pictures.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace shadowproof {

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

PointPictures::PointPictures(const ReplacedFolder& folder)
    : part_{folder, std::string(pictures_folder) + "/"} {}

void PointPictures::begin(SceneResult& scene) {
    scene_ = &scene;
    begun_ = scene.name;
    group_of_.clear();
}

std::size_t PointPictures::begin_group(const BenchSettings& settings) {
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

std::string PointPictures::add(const BenchSettings& settings, Cell cell, int threads) {
    const auto lock = hold_unfinished();
    try {
        return write(settings, std::move(cell), threads);
    } catch (const std::bad_alloc&) {
        return {};
    } catch (const Error& error) {
        throw std::runtime_error(error.what());
    }
}

std::string PointPictures::write(const BenchSettings& settings, Cell cell, int threads) {
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

void PointPictures::finish(Report report) {
    if (groups_.empty()) return;
    const auto lock = hold_unfinished();
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

} // namespace shadowproof
