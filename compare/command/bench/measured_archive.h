// What pieces of bench result in, and how it goes from process to process.
#pragma once

#include "compare/command/bench/bench_archive.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// A point that was drawn once and judged.
struct JudgedPoint {
    std::optional<BenchPoint> point{}; ///< none: it cannot be drawn
    std::string why{};                 ///< then
};

SHADOWPROOF_SEND_ALL(JudgedPoint, point, why)

/// One sample of a point.
struct BenchSample {
    double milliseconds = 0;
    std::vector<BenchStage> stages{}; ///< of one further frame
};

SHADOWPROOF_SEND_ALL(BenchSample, milliseconds, stages)

/// A part of a run, such as what a scene adds to it.
struct MeasuredPart {
    BenchRun run{};
    bool complete = true; ///< all that was asked for was measured
};

SHADOWPROOF_SEND_ALL(MeasuredPart, run, complete)

} // namespace shadowproof
