// Joins the results of several runs, shards by scene or by technique, into those of one run.
#pragma once

#include "compare/report/report_files.h"
#include "compare/results/results_file.h"
#include "scenes/cause.h"

#include <string>
#include <vector>

namespace shadowproof {

struct KnownTechnique {
    std::string name;
    std::vector<Cause> fails_at;
    bool on_every_scene = true; ///< if not, another technique, which is, has the same shadows
};

/// What a whole run tries.
struct Matrix {
    std::vector<KnownTechnique> techniques; ///< in the order of the registry
    std::vector<std::string> scenes;        ///< the bundled ones
};

struct Merged {
    ResultsJson results;
    std::vector<ReportFile> files; ///< that its report needs, and where they are
};

/// Runs that have passed read_results, at least one; one alone stays as it is. Scenes keep the
/// order in which they come; the techniques of a scene that several runs tried are in the order of
/// the matrix. Times of runs are added up; a scene's reference keeps those of its first run. The
/// gate is the first run's, and cells that were judged by another one name it. Whether a scene
/// stopped provoking its causes is decided again if shards by technique make up a whole. Throws
/// Error naming both files, the field and its values where runs do not belong together (driver,
/// versions, settings, a scene's content), and where two runs have tried the same cell.
Merged merge(const std::vector<ResultsFile>& runs, const Matrix& matrix);

} // namespace shadowproof
