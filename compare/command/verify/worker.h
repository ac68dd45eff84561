// The process that tries scenes: reads, traces, draws and judges, writes the pictures, and tells by
// messages what came of it.
#pragma once

#include "compare/baseline.h"
#include "compare/command/console.h"
#include "compare/command/gate_options.h"
#include "compare/command/options.h"
#include "compare/report.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

struct VerifyOptions {
    std::vector<std::string> scenes; ///< names or paths; empty: all bundled ones
    SceneOptions scene;
    TechniqueOptions technique;
    GateOptions gate;
    OutputOptions output;
    double timeout = 600; ///< seconds for a cell, or for reading or tracing a scene; 0: any
};

/// The scenes asked for, by name or path.
std::vector<std::string> scenes_to_verify(const VerifyOptions& options);

/// Columns of the cells' lines of one scene.
ColumnWidths widths_of(const TechniqueOptions& techniques, const std::string& scene);

/// Where a worker begins: behind what others did before it.
struct StartingPoint {
    std::size_t scene = 0; ///< into scenes_to_verify
    std::size_t light = 0; ///< of that scene
    /// The light's result so far, where techniques were tried under it: they are passed over.
    std::optional<SceneResult> begun;
    std::vector<std::string> folders; ///< of the report that other results have taken
};

/// What a worker is given.
struct WorkerSetup {
    const VerifyOptions& options;
    const std::optional<ResultsFile>& baseline;
    Console& console;
    ReportFolder& folder;
    int pipe = -1; ///< for messages
};

/// Tries all scenes from a starting point on. Returns when all are tried or the run cannot go on,
/// which the last message says. Throws where nobody reads the messages any more.
void try_scenes(const WorkerSetup& setup, StartingPoint from);

} // namespace shadowproof
