// Keeps what a benchmark has measured so far in its --json file, so that a run which is stopped can
// go on.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/command/process/stopwatch.h"
#include "scenes/memory_budget.h"

#include <optional>
#include <string>

namespace shadowproof {

class BenchKeeper {
public:
    /// Nothing is kept where `file` is empty, or is written into (a device, a pipe, /dev/stdout):
    /// all that is kept would stay there, before the finished run. Throws Error naming a file that
    /// could not be written. `earlier`: the run that is gone on with; null: none.
    BenchKeeper(const std::string& file, const BenchRun* earlier);

    /// Replaces the file, whole, at most every few seconds, by the run and what the earlier one has
    /// beside it (with_kept). Points without samples are left out.
    void keep(const BenchRun& run);

private:
    std::string file_; ///< empty: nothing is kept
    const BenchRun* earlier_;
    std::optional<Stopwatch> since_;
};

/// What an earlier run left in the file; none if there is no such file.
std::optional<BenchRun> kept_run(const std::string& file, MemoryAccount& memory);

/// Throws Error naming the file where the kept run was of another version, driver or machine than
/// the one that begins now, or had other settings.
void require_same_settings(const std::string& file, const BenchRun& kept, const BenchRun& now);

/// The scene's earlier result; null where there is none. Throws Error naming the file where the
/// scene of that name had other content, another size or light.
const BenchScene* kept_scene(const std::string& file, const BenchRun& kept, const BenchScene& now);

} // namespace shadowproof
