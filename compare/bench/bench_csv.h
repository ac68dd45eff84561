// A benchmark as CSV (RFC 4180): one line per point, for spreadsheets and other programs that plot.
#pragma once

#include "compare/bench/bench_run.h"

#include <string>

namespace shadowproof {

/// Shares are of the picture's pixels, times in milliseconds, colours in steps of 1/255. A column
/// for each cause and each stage (ms_<name>, the median) that some point has.
std::string bench_csv(const BenchRun& run);

} // namespace shadowproof
