// A run that goes on with an earlier one: nothing of what was measured then is lost.
#pragma once

#include "compare/bench/bench_run.h"

namespace shadowproof {

/// Whether both are of the same content, size and light.
bool are_one_picture(const BenchScene& a, const BenchScene& b);

/// The run, and behind it what the earlier one has beside it: scenes, points, lines of growth and
/// what was left out. Points without samples are dropped. Where both have a point, the run's holds;
/// a line of growth that both have is the one with more sizes. What was left out stays unless the
/// run has measured it. Pictures of points that are the earlier run's alone are another plot's, and
/// not named. A scene is finished if it is in each run that has points of it; the whole is if the
/// run is, and each scene of the earlier one alone.
BenchRun with_kept(BenchRun run, const BenchRun& earlier);

} // namespace shadowproof
