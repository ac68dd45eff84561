// The machine that a benchmark runs on, as results name it.
#pragma once

#include "compare/bench/bench_run.h"

namespace shadowproof {

/// By /proc/cpuinfo, the cores that this process may use, and uname(2). What cannot be found out is
/// "unknown", or 0.
BenchMachine this_machine();

} // namespace shadowproof
