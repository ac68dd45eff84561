// The pictures of points that bench and stress draw: a report like that of verify, within the
// folder of the plot.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/cell.h"
#include "compare/output/replaced_folder.h"
#include "compare/report/report.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace shadowproof {

/// The folder of the pictures, within that of the plot, and files that it has in any case.
inline constexpr const char* pictures_folder = "pictures";
std::vector<std::string> fixed_pictures();

/// A cell is written as soon as it is judged. Cells of a scene with the same settings, flags or
/// stress parameters, form a scene of the report, called after both: "near_plane-map-size-64".
class PointPictures {
public:
    explicit PointPictures(const ReplacedFolder& folder);

    /// Further cells are of this scene, whose truth is known; it must outlive them. Its name is
    /// changed while cells are written.
    void begin(SceneResult& scene);
    /// Writes the cell. Returns its address, relative to the folder of the plot:
    /// "pictures/index.html#near_plane/zpass"; none where memory ran out. Throws
    /// std::runtime_error, which is no Error of the scene's, where it cannot be written.
    std::string add(const BenchSettings& settings, Cell cell, int threads);
    /// Writes the page, if there is any cell. `run`: a report's version, driver and arguments.
    void finish(Report run);

private:
    FolderPart part_;
    SceneResult* scene_ = nullptr;
    std::string begun_;               ///< its name
    std::vector<SceneResult> groups_; ///< their pictures are written, and dropped
    /// Which of them has the scene's cells with these settings.
    std::map<BenchSettings, std::size_t> group_of_;

    std::size_t begin_group(const BenchSettings& settings);
    std::string write(const BenchSettings& settings, Cell cell, int threads);
};

} // namespace shadowproof
