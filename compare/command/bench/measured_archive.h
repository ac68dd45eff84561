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

template <class Archive>
void serialize(Archive& archive, JudgedPoint& judged) {
    auto& [point, why] = judged;
    archive(point, why);
}

/// One sample of a point.
struct BenchSample {
    double milliseconds = 0;
    std::vector<BenchStage> stages{}; ///< of one further frame
};

template <class Archive>
void serialize(Archive& archive, BenchSample& sample) {
    auto& [milliseconds, stages] = sample;
    archive(milliseconds, stages);
}

/// A part of a run, such as what a scene adds to it.
struct MeasuredPart {
    BenchRun run{};
    bool complete = true; ///< all that was asked for was measured
};

template <class Archive>
void serialize(Archive& archive, MeasuredPart& part) {
    auto& [run, complete] = part;
    archive(run, complete);
}

} // namespace shadowproof
