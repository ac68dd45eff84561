// Reads the JSON of a benchmark, and refuses what docs/bench.schema.json does not allow or whose
// figures contradict each other.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/json/json_file.h"

#include <filesystem>
#include <string>

namespace shadowproof {

/// Throws Error naming `file`, the JSON pointer of the first value that is not as it must be, and
/// the remedy. Members that it does not know are a newer writer's, and accepted.
void check_bench(const ResultsJson& bench, const std::string& file);

/// `path`: a file that `bench --json` wrote, or the folder of its plot. Throws Error as above.
BenchRun read_bench(const std::filesystem::path& path, MemoryAccount* memory = nullptr);

} // namespace shadowproof
