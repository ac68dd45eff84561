// A benchmark as JSON of schema shadowproof/bench/1 (docs/bench.schema.json), and back.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/json/json_file.h"

#include <string>
#include <string_view>

namespace shadowproof {

inline constexpr std::string_view bench_schema = "shadowproof/bench/1";

ResultsJson bench_json(const BenchRun& run);

/// JSON that was checked (check_bench) as a run.
BenchRun bench_of_json(const ResultsJson& json);

} // namespace shadowproof
