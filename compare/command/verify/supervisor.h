// The supervisor process: gathers the results of workers. If a worker crashes or takes too long, it
// records that at the cell and starts another worker after it.
#pragma once

#include "compare/command/verify/worker.h"

namespace shadowproof {

/// Verifies all scenes, and puts the results into the report, with the names of driver and Embree.
/// Throws Error if the run cannot go on.
void try_scenes_guarded(const VerifyOptions& options, const std::optional<ResultsFile>& baseline,
                        Console& console, ReportFolder& folder, Report& report);

} // namespace shadowproof
