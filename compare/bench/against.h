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
    std::vector<std::string> orders; ///< changed_orders, one sentence each
    std::size_t compared = 0;        ///< points
};

/// Points are the same if scene, technique and settings are. A time is lost where all of its
/// interval lies above all of the older one's, and gained the other way round; times without both
/// intervals are not compared, and counted in a note. Errors have no interval: any further wrong
/// pixel, and any larger rmse of colours, is a loss. Points of scenes whose content, size or light
/// differ are not compared.
BenchChanges changes_between(const BenchRun& older, const BenchRun& newer);

/// Two points of a scene that changed places: one was quicker beyond both intervals, and now the
/// other is. Places in the newer run.
struct ChangedOrder {
    std::size_t quicker = 0; ///< now
    std::size_t slower = 0;  ///< now
};

/// Of all pairs of points that both runs have, on the same picture. Repeating a run on the same
/// machine ought to give none.
std::vector<ChangedOrder> changed_orders(const BenchRun& older, const BenchRun& newer);

} // namespace shadowproof
