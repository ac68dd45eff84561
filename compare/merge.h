// Joins the results of several runs into those of one, as if one run had got them all: shards by
// scene, or by technique.
#pragma once

#include "compare/report_files.h"
#include "compare/results_file.h"
#include "scenes/cause.h"

#include <string>
#include <vector>

namespace shadowproof {

struct KnownTechnique {
    std::string name;
    std::vector<Cause> fails_at;
    bool on_every_scene = true; ///< otherwise its shadows are those of another that is
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

/// Runs that have passed read_results, at least one; one alone stays as it is. Scenes stand in the
/// order in which they come; the techniques of one that several runs tried in that of the matrix.
/// Times of runs are added up; a scene's reference keeps those of its first run. Whether a scene
/// stopped provoking its causes is asked again where shards by technique make up a whole.
/// Throws Error naming both files, the field and its values where runs do not belong together
/// (driver, versions, settings, a scene's content), and where two runs have tried the same cell.
Merged merge(const std::vector<ResultsFile>& runs, const Matrix& matrix);

} // namespace shadowproof
