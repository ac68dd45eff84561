// The end of a run, alike for all commands that judge one: files, console, exit code.
#pragma once

#include "compare/command/console.h"
#include "compare/command/gate_options.h"
#include "compare/report.h"

#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// Now as JUnit wants it: UTC, "2024-01-31T23:59:59".
std::string timestamp_now();

/// Throws Error where --json or --junit could not be written: before the work, not after.
void check_outputs(const OutputOptions& options, std::span<const std::string> read);

/// Causes that a bundled scene declares and no technique shows any more, under any of its lights:
/// `lights` are its results. Only the scene's default picture, and all techniques under all its
/// lights, can tell: none where anything else was tried, or one of them could not run.
std::vector<std::string> stopped_provoking(const Report& report,
                                           std::span<const SceneResult> lights);

/// A scene or a gate that fails a run fails it, whatever else passes.
bool passes(const Report& report);

/// Finishes the report, with --json and --junit in it where they lie in its folder, and says what
/// it kept there.
void finish(ReportFolder& folder, Console& console, const Report& report,
            const OutputOptions& options, const std::string& started);

/// Writes --json and --junit where they lie elsewhere; under GitHub Actions the lines that it shows
/// as errors, and the step summary; says how to see again what failed, and where the report lies.
/// Returns the exit code.
int conclude(Console& console, const Report& report, const OutputOptions& options,
             const std::string& started);

} // namespace shadowproof
