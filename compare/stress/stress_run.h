// What stress finds as plain data: how each technique fares along each parameter of each scene.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/loss.h"
#include "compare/verdict.h"
#include "reference/witness/agreement.h"
#include "reference/witness/relation_check.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// One technique at a point.
struct StressCell {
    std::string technique{};
    std::string family{};
    double milliseconds = 0; ///< of its one frame
    double judging = 0;      ///< milliseconds, of frame, judgement and what a report shows
    BenchError error{};
    std::optional<double> strain{}; ///< Judge::strain
    Verdict verdict = Verdict::agrees;
    std::string refused{};  ///< why it could not be drawn; then the numbers mean nothing
    Loss loss = Loss::none; ///< if not none, `refused` says what happened, and the run fails
    std::string command{};  ///< that shows it again
    std::string pictures{}; ///< as in BenchPoint
};

/// Whether any pixel is wrong, or the technique could not be drawn.
bool has_failed(const StressCell& cell);

/// A scene at a parameter's value, its truth, and all techniques that were tried there.
struct StressPoint {
    double value = 0;
    bool own = false;       ///< the scene as it is
    bool searched = false;  ///< between two values of the ladder, in search of a breaking point
    std::string refused{};  ///< why there is no such scene; then it has no cells
    Loss loss = Loss::none; ///< as in StressCell, while it was made or traced
    std::uint64_t triangles = 0;
    double trace_milliseconds = 0;
    std::uint64_t rays = 0;
    std::uint64_t exact_decisions = 0;
    std::uint64_t degenerate = 0; ///< pixels
    Agreement witness{};
    RelationCheck relations{};
    std::vector<StressCell> cells{};
};

/// Where a technique, right on the scene as it is, starts to fail as a parameter leaves its value,
/// as measured, and where it is expected to.
struct Breaking {
    std::string technique{};
    bool up = false;             ///< the side: values above the scene's own
    double holds = 0;            ///< the last value known at which no pixel is wrong
    std::optional<double> fails; ///< the first known at which one is; none: within the range never
    double derived_holds = 0;    ///< the last value up to which no strain reaches 1
    std::optional<double> derived; ///< the first known at which one does
    std::string cause{};           ///< the most frequent there, or "refused", or a loss's name
    bool refused = false;          ///< it was not drawn there, refused or lost
};

struct StressAlong {
    std::string parameter{};
    std::string words{};                     ///< what its values are
    std::vector<StressPoint> points{};       ///< by value
    std::vector<Breaking> breaking{};        ///< techniques in order, first downwards, then upwards
    std::vector<std::string> wrong_before{}; ///< techniques wrong on the scene as it is
};

struct StressScene {
    std::string name{};
    std::string file{};
    std::string digest{};
    std::string light{};
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    std::uint64_t triangles = 0;
    std::string error{}; ///< why it could not be read; then there is nothing else
    std::vector<StressAlong> parameters{};
    std::vector<std::string> left_out{}; ///< parameters that do not suit it
};

struct StressRun {
    std::string version{};
    DriverInfo gl{};
    std::string embree{};
    std::vector<std::string> arguments{}; ///< what all points were made with
    std::vector<StressScene> scenes{};
};

/// How often something happened in the whole run.
struct StressTally {
    std::uint64_t points = 0; ///< scenes that were traced
    std::uint64_t cells = 0;
    std::uint64_t unexplained = 0; ///< cells
    std::uint64_t asked = 0;       ///< pixels, of the witness
    std::uint64_t disagreements = 0;
    std::uint64_t relations_tried = 0; ///< on all scenes together
    std::uint64_t changed = 0;         ///< pixels whose truth a relation changed
};
StressTally tally_of(const StressRun& run);

} // namespace shadowproof
