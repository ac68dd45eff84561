// Compares two runs of a benchmark: what became slower or more wrong.
#pragma once

#include "compare/bench/bench_run.h"

#include <cstddef>
#include <string>
#include <vector>

namespace shadowproof {

struct BenchChanges {
    std::vector<std::string> losses; ///< what became worse, one sentence each
    std::vector<std::string> gains;  ///< what became better, one sentence each
    std::vector<std::string> notes;  ///< what makes the runs differ, and what cannot be compared
    std::size_t compared = 0;        ///< points
};

/// Points are the same if scene, technique and settings are. A time is lost where all of its
/// interval lies above all of the older one's, and gained the other way round. Errors have no
/// interval: any further wrong pixel, and any larger rmse of colours, is a loss. Points of scenes
/// whose content, size or light differ are not compared.
BenchChanges changes_between(const BenchRun& older, const BenchRun& newer);

} // namespace shadowproof
