// The end of a run, the same for all commands that judge one: files, console, exit code.
#pragma once

#include "compare/command/gate_options.h"
#include "compare/command/process/console.h"
#include "compare/report/report.h"
#include "compare/results/baseline.h"

#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// The current time as JUnit has it: UTC, "2024-01-31T23:59:59".
std::string timestamp_now();

/// Throws Error if --json or --junit cannot be written. To be called before the work.
void check_outputs(const OutputOptions& options, std::span<const std::string> read);

/// Causes that a bundled scene declares but no technique shows any more under any of its lights;
/// `lights`: its results. Empty unless all techniques ran on its default picture under all its
/// lights: fewer results cannot tell.
std::vector<std::string> stopped_provoking(const Report& report,
                                           std::span<const SceneResult> lights);

/// Whether no scene fails by the report's gate.
bool passes(const Report& report);

/// Finishes the report, including --json and --junit if they lie in its folder, and prints which
/// files were kept there.
void finish(ReportFolder& folder, Console& console, Report& report, const OutputOptions& options,
            const std::string& started);

/// Writes --json and --junit if they lie elsewhere and, under GitHub Actions, error annotations and
/// the step summary. Prints how to reproduce what failed, and where the report is. Returns the exit
/// code.
int conclude(Console& console, const Report& report, const OutputOptions& options,
             const std::string& started);

/// The end of a run whose cells are judged, but for report.milliseconds: compares it with the
/// baseline, if any, finishes the report and concludes. Returns the exit code.
int end_run(ReportFolder& folder, Console& console, Report& report, const GateOptions& gate,
            const std::optional<ResultsFile>& baseline, const OutputOptions& output,
            const std::string& started);

} // namespace shadowproof
