// The work of verify's worker process: reads, traces, draws and judges scenes, and writes the
// pictures.
#pragma once

#include "compare/command/gate_options.h"
#include "compare/command/options.h"
#include "compare/command/pieces/report_archive.h"
#include "compare/command/pieces/supervisor.h"
#include "compare/command/process/console.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/verify/costs.h"
#include "compare/command/verify/shard.h"
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
    double timeout =
        usual_timeout; ///< seconds for a cell, or for reading or tracing a scene; 0: no limit
    std::optional<Shard> shard; ///< only this part of the run
    std::string costs;   ///< an earlier results.json, by whose times shards are cut; or empty
    bool resume = false; ///< go on with a run that was cut off
};

/// The scenes asked for, by name or path.
std::vector<std::string> scenes_to_verify(const VerifyOptions& options);

/// What a worker is given.
struct WorkerSetup {
    const VerifyOptions& options;
    const Report& begun; ///< the report before its first scene
    const std::optional<ResultsFile>& baseline;
    const Costs& costs;
    bool resumed; ///< an earlier run has done some of the work
    Console& console;
    const Stopwatch& stopwatch; ///< since the first scene began, over all workers
    const ReportFolder& folder;
    Pieces& pieces;
};

struct VerifiedScenes {
    DriverInfo gl{};
    std::string embree{};
    std::vector<SceneResult> scenes{};
    double report_milliseconds = 0; ///< as in Report
    std::string plan{};             ///< of a shard: the name of the whole run's
};

SHADOWPROOF_SEND_ALL(VerifiedScenes, gl, embree, scenes, report_milliseconds, plan)

/// Tries all scenes: each is a piece, and so is each cell. Throws where the run cannot go on.
VerifiedScenes try_scenes(const WorkerSetup& setup);

} // namespace shadowproof
