#include "compare/command/point_pictures.h"

#include "compare/command/pieces/report_archive.h"
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

SHADOWPROOF_SEND_ALL(PictureGroup, scene, point, settings, written, result)
SHADOWPROOF_SEND_ALL(PictureNews, group, begun, cell)

std::vector<std::string> fixed_pictures() {
    std::vector<std::string> files;
    for (const char* name : {page_name, results_name, results_script_name})
        files.push_back(std::string(pictures_folder) + "/" + name);
    return files;
}

PointPictures::PointPictures(const ReplacedFolder& folder)
    : part_{folder, std::string(pictures_folder) + "/"}, memo_(std::make_unique<Memo>()) {}

void PointPictures::begin(SceneResult& scene, std::string point) {
    scene_ = &scene;
    begun_ = scene.name;
    point_ = std::move(point);
}

void PointPictures::keep(const std::string& bytes) {
    take(unpacked<PictureNews>(bytes));
}

void PointPictures::take(PictureNews news) {
    if (news.begun) {
        groups_.push_back(std::move(*news.begun));
        return;
    }
    PictureGroup& group = groups_[news.group];
    if (news.cell)
        group.result.cells.push_back(std::move(*news.cell));
    else
        group.written = true;
}

void PointPictures::tell(PictureNews news) {
    if (send_) send_(packed(news));
    take(std::move(news));
}

/// A group whose shared pictures an earlier worker did not get written keeps its name, and another
/// one takes its place.
std::size_t PointPictures::group_for(const BenchSettings& settings) {
    const auto found = std::ranges::find_if(groups_, [&](const PictureGroup& group) {
        return group.written && group.scene == begun_ && group.point == point_ &&
               group.settings == settings;
    });
    if (found != groups_.end()) return static_cast<std::size_t>(found - groups_.begin());
    const std::string wanted = name_of(begun_, settings);
    scene_->name = wanted;
    const auto is_taken = [&](const PictureGroup& other) {
        return folder_of(other.result) == folder_of(*scene_);
    };
    for (int number = 2; std::ranges::any_of(groups_, is_taken); ++number)
        scene_->name = fmt::format("{}-{}", wanted, number);
    const std::size_t number = groups_.size();
    tell({.group = number,
          .begun = PictureGroup{.scene = begun_,
                                .point = point_,
                                .settings = settings,
                                .written = false,
                                .result = without_pictures(*scene_)}});
    memo_->forget();
    write_scene(*scene_, part_);
    tell({.group = number});
    return number;
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
    const std::size_t number = group_for(settings);
    scene_->name = groups_[number].result.name;
    write_cell(*scene_, cell, part_, *memo_, nullptr, threads);
    cell.frame = {};
    cell.evidence.reset();
    cell.comparison.cause = {};
    cell.comparison.also = {};
    cell.comparison.evidence_miss = {};
    if (cell.comparison.colors) {
        cell.comparison.colors->error = {};
        cell.comparison.colors->verdict = {};
    }
    const std::string technique = cell.technique;
    tell({.group = number, .begun = {}, .cell = std::move(cell)});
    return part_.below + page_name + "#" + folder_of(groups_[number].result) + "/" + technique;
}

void PointPictures::finish(Report report) {
    std::erase_if(groups_, [](const PictureGroup& group) { return group.result.cells.empty(); });
    if (groups_.empty()) return;
    const auto lock = hold_unfinished();
    for (PictureGroup& group : groups_) report.scenes.push_back(std::move(group.result));
    groups_.clear();
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
