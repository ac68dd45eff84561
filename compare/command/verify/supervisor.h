// The process that watches over those that try scenes: it gathers their results, and where one of
// them crashes or takes too long, says so at the cell and starts another behind it.
#pragma once

#include "compare/command/verify/worker.h"

namespace shadowproof {

/// Tries all scenes; the results are in the report, with the names of driver and Embree. Throws
/// Error where the run cannot go on.
void try_scenes_guarded(const VerifyOptions& options, const std::optional<ResultsFile>& baseline,
                        Console& console, ReportFolder& folder, Report& report);

} // namespace shadowproof
