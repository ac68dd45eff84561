// The pictures of an earlier benchmark.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/output/replaced_folder.h"
#include "scenes/memory_budget.h"

#include <string>

namespace shadowproof {

/// Takes over the pictures of an earlier run, given as its plot's folder or the results.json there:
/// those files that its manifest lists and nobody has changed, and a new page. Points whose cell is
/// not there lose their address; with `wanted` false all do.
void take_over_pictures(const std::string& from, const MemoryAccount& memory, BenchRun& run,
                        const ReplacedFolder& folder, bool wanted);

} // namespace shadowproof
