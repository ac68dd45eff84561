// A benchmark as CSV (RFC 4180): one line per point, for spreadsheets and other programs that plot.
#pragma once

#include "compare/bench/bench_run.h"

#include <string>

namespace shadowproof {

/// Of a run along sizes alone, a line per technique and size, as growth_csv has it. Else shares are
/// of the picture's pixels, times in milliseconds, colours in steps of 1/255. A column for each
/// cause and each stage (ms_<name>, the median) that some point has.
std::string bench_csv(const BenchRun& run);

/// A line per technique and size of each growth; what was fitted stands in each of its lines.
std::string growth_csv(const BenchRun& run);

} // namespace shadowproof
