// Joins the results of several runs, shards of one run or runs of other scenes or techniques, into
// those of one run.
#pragma once

#include "compare/report/report_files.h"
#include "compare/results/results_index.h"
#include "scenes/cause.h"

#include <string>
#include <vector>

namespace shadowproof {

struct KnownTechnique {
    std::string name;
    std::vector<Cause> fails_at;
    bool on_every_scene = true; ///< if not, another technique, which is, has the same shadows
    std::vector<std::string> lights{}; ///< it is for these kinds alone; empty: for all
};

/// What a whole run tries.
struct Matrix {
    std::vector<KnownTechnique> techniques; ///< in the order of the registry
    std::vector<std::string> scenes;        ///< the bundled ones
};

/// A cell of the joined results, and where it stands.
struct MergedCell {
    std::size_t run = 0;
    std::size_t scene = 0; ///< of the run
    std::size_t cell = 0;  ///< of the scene
    IndexedCell what;
};

struct MergedScene {
    ResultsJson head;      ///< as it will be, without its cells
    std::size_t run = 0;   ///< that brought it
    std::size_t scene = 0; ///< of that run
    std::vector<MergedCell> cells;
    bool of_several_runs = false; ///< its cells
};

/// The joined results but for their cells, which are read when they are written: so there may be
/// more of them than memory holds.
struct Merged {
    ResultsJson head; ///< "scenes" is an empty list
    std::vector<MergedScene> scenes;
};

/// Runs that have passed index_results, at least one. Shards are put in order, and must be all of
/// their run; they become what that run would have written, times apart. Scenes of other runs keep
/// the order in which they come, and the techniques of a scene that several of them tried are in
/// the order of the matrix. Times of runs are added up; a scene's reference keeps those of its
/// first run. The gate is the first run's, and cells that were judged by another one name it.
/// Whether a scene stopped provoking its causes is decided again if its parts make up a whole.
/// Throws Error naming both files, the field and its values where runs do not belong together
/// (driver, versions, settings, a scene's content), and where two runs have tried the same cell.
Merged merge(std::vector<IndexedResults>& runs, const Matrix& matrix);

/// The results of one run as they are, be it a shard.
Merged alone(const IndexedResults& run);

/// A scene of the joined results with its cells, and the files that its report needs. Those name
/// places in `json`.
struct WholeScene {
    ResultsJson json;
    std::vector<ReportFile> files;
};

/// `runs`: as merge() has left them.
WholeScene whole_scene(const Merged& merged, std::size_t index,
                       const std::vector<IndexedResults>& runs);

} // namespace shadowproof
