// The pictures of points that bench and stress draw: a report like that of verify, within the
// folder of the plot.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/cell.h"
#include "compare/output/replaced_folder.h"
#include "compare/report/report.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// The folder of the pictures, within that of the plot, and files that it has in any case.
inline constexpr const char* pictures_folder = "pictures";
std::vector<std::string> fixed_pictures();

/// A scene of their report.
struct PictureGroup {
    std::string scene{}; ///< whose cells it has
    std::string point{};
    BenchSettings settings{};
    bool written = false; ///< the pictures that its cells share; until then it has no cells
    SceneResult result{}; ///< without pictures, which are on disk
};

/// What happened to a group: it was begun, its shared pictures were written, or a cell's were.
struct PictureNews {
    std::size_t group = 0;
    std::optional<PictureGroup> begun{};
    std::optional<Cell> cell{};
};

/// A cell is written as soon as it is judged. Cells of a scene with the same settings, flags or
/// stress parameters, form a scene of the report, called after both: "near_plane-map-size-64".
///
/// Workers draw and write; their supervisor keeps what was written, and finishes the report. A
/// worker starts with what the supervisor kept of earlier ones.
class PointPictures {
public:
    explicit PointPictures(const ReplacedFolder& folder);

    /// In a worker: what is written is sent, packed, for keep().
    void send_by(std::function<void(std::string)> send) { send_ = std::move(send); }
    /// In the supervisor: takes what a worker sent.
    void keep(const std::string& bytes);

    /// In a worker: further cells are of this scene, whose truth is known; it must outlive them.
    /// Its name is changed while cells are written. `point` tells it from others of its name, as
    /// settings may read alike.
    void begin(SceneResult& scene, std::string point = {});
    /// Writes the cell. Returns its address, relative to the folder of the plot:
    /// "pictures/index.html#near_plane/zpass"; none where memory ran out. Throws
    /// std::runtime_error, which is no Error of the scene's, where it cannot be written.
    std::string add(const BenchSettings& settings, Cell cell, int threads);
    /// Writes the page, if there is any cell. `run`: a report's version, driver and arguments.
    void finish(Report run);

private:
    FolderPart part_;
    std::unique_ptr<Memo> memo_; ///< of the group that was begun last
    SceneResult* scene_ = nullptr;
    std::string begun_; ///< its name
    std::string point_;
    std::vector<PictureGroup> groups_;
    std::function<void(std::string)> send_;

    std::size_t group_for(const BenchSettings& settings);
    std::string write(const BenchSettings& settings, Cell cell, int threads);
    void take(PictureNews news);
    void tell(PictureNews news);
};

} // namespace shadowproof
