// The worker process: reads, traces, draws and judges scenes, writes the pictures, and reports the
// results by messages.
#pragma once

#include "compare/command/console.h"
#include "compare/command/gate_options.h"
#include "compare/command/options.h"
#include "compare/report/report.h"
#include "compare/results/baseline.h"

#include <cstdint>
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
    std::uint64_t witness = 0; ///< pixels that a second exact tracer decides again
    double timeout = 600; ///< seconds for a cell, or for reading or tracing a scene; 0: no limit
};

/// The scenes asked for, by name or path.
std::vector<std::string> scenes_to_verify(const VerifyOptions& options);

/// Column widths of one scene's cell lines.
ColumnWidths widths_of(const TechniqueOptions& techniques, const std::string& scene);

/// Where a worker begins: after what earlier workers did.
struct StartingPoint {
    std::size_t scene = 0; ///< into scenes_to_verify
    std::size_t light = 0; ///< of that scene
    /// The light's result so far; techniques already tried under it are skipped.
    std::optional<SceneResult> begun;
    std::vector<std::string> folders; ///< folders of the report that other results have taken
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
/// which the last message says. Throws if the messages have no reader any more.
void try_scenes(const WorkerSetup& setup, StartingPoint from);

} // namespace shadowproof
