// A benchmark as lines for the console.
#pragma once

#include "compare/bench/bench_run.h"

#include <string>
#include <vector>

namespace shadowproof {

/// A scene's points as a table, the quickest first, with a head line. A star marks the front: no
/// other point is both as quick and as right. Empty where the scene has no points.
std::vector<std::string> bench_table(const BenchRun& run, const std::string& scene);

/// A line for each growth, with its exponent and where it breaks; a head line before.
std::vector<std::string> growth_table(const BenchRun& run);

/// Whether no other technique's point of the same scene is at most as slow and at most as wrong,
/// and better in one of both: by median times and wrong pixels. The truth is their yardstick, and
/// never on the front.
bool is_on_front(const BenchRun& run, const BenchPoint& point);

} // namespace shadowproof
