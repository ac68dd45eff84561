// The pictures of a benchmark's points: a report like that of verify, within the folder of the
// plot.
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

/// A cell is written as soon as it is judged. Cells with the same settings form a scene of the
/// report, which is called after both: "near_plane-map-size-64".
class BenchPictures {
public:
    explicit BenchPictures(const ReplacedFolder& folder) : part_{folder, "pictures/"} {}

    /// Further cells are of this scene, whose truth is known.
    void begin(SceneResult scene);
    /// Writes the cell. Returns its address, relative to the folder of the plot:
    /// "pictures/index.html#near_plane/zpass".
    std::string add(const BenchSettings& settings, Cell cell, int threads);
    /// Writes the page, if there is any cell.
    void finish(const BenchRun& run);

private:
    FolderPart part_;
    SceneResult scene_;               ///< the one that was begun
    std::string begun_;               ///< its name
    std::vector<SceneResult> groups_; ///< their pictures are written, and dropped
    /// Which of them has the scene's cells with these settings.
    std::map<BenchSettings, std::size_t> group_of_;

    std::size_t begin_group(const BenchSettings& settings);
};

/// Takes the pictures of an earlier run's folder over, or takes their addresses off its points
/// where there are none.
void take_over_pictures(const std::string& from, BenchRun& run, const ReplacedFolder& folder);

} // namespace shadowproof
