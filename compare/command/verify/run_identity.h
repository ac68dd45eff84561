// What a run is, to tell whether two processes do the same one: shards of it, or one that goes on
// where another was cut off.
#pragma once

#include "compare/command/verify/worker.h"

#include <string>
#include <vector>

namespace shadowproof {

/// JSON of what is tried, with which settings, and against what; the same for all shards of a run.
/// `arguments`: the settings as in Report. Throws Error where a file that it reads cannot be read.
ResultsJson run_identity(const VerifyOptions& options, const std::vector<std::string>& arguments);

/// The identity in a few characters, with what was planned (plan_name): the same for shards that
/// were cut of the same whole.
std::string run_name(ResultsJson identity, const std::string& plan);

/// The identity of one process of a run: with its shard, and the program itself, whose results
/// another build could not read.
std::string process_identity(ResultsJson identity, const VerifyOptions& options);

/// Throws Error naming the folder `out` and the first member that differs, where the process that
/// was cut off was not the same as this one.
void require_same_process(const std::string& out, const std::string& cut_off,
                          const std::string& now);

} // namespace shadowproof
