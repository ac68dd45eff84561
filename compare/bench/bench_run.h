// A benchmark's result as plain data: error and time of each technique and setting on each scene.
#pragma once

#include "compare/bench/growth.h"
#include "compare/bench/interval.h"
#include "compare/loss.h"
#include "scenes/frame.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

/// Names and values, in the order in which they are shown: {"normalise", "cube-map"}.
using BenchSettings = std::vector<std::pair<std::string, std::string>>;

/// The name of the point that is the exact truth itself.
inline constexpr const char* truth_point = "truth";

/// Where colours are judged; steps of 1/255.
struct BenchColor {
    double rmse = 0;
    double largest = 0;
    double percentile999 = 0; ///< 99.9 % of the judged pixels' errors are no larger
};

/// How wrong a claim is. Pixels; those of `edge` count as differing, and not as falsely anything.
struct BenchError {
    std::uint64_t pixels = 0; ///< of the picture
    std::uint64_t differing = 0;
    // Pixels; one that is partly lit counts by the share of the light by which it is off.
    double falsely_lit = 0;
    double falsely_shadowed = 0;
    std::vector<std::pair<std::string, std::uint64_t>> causes{}; ///< in the order of all_causes
    std::optional<BenchColor> color{};
};

/// Pixels that differ for another cause than `edge`.
std::uint64_t wrong_pixels(const BenchError& error);

/// A part of a point's frames.
struct BenchStage {
    std::string name{};
    std::vector<double> samples{}; ///< milliseconds, as many as the point has
};

/// One technique with some settings on one scene.
struct BenchPoint {
    std::string scene{};
    std::string technique{};
    std::string family{};
    BenchSettings settings{};         ///< that were asked for; the technique's own are in `own`
    BenchSettings own{};              ///< what it takes by itself, where settings are swept
    std::vector<double> samples{};    ///< milliseconds, in the order of measuring
    std::vector<BenchStage> stages{}; ///< of frames that waited for each of them
    BenchError error{};
    std::string command{}; ///< that measures it again
    /// Where its pictures are, relative to the folder of the plot; empty: they were not kept.
    std::string pictures{};
};

struct BenchScene {
    std::string name{};
    std::string file{};
    std::string digest{}; ///< of the scene's content
    std::string light{};
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    std::uint64_t triangles = 0;
    bool finished = false; ///< no point of it needs a further sample
};

/// What was not measured, and why.
struct BenchLeftOut {
    std::string scene{};
    std::string technique{}; ///< empty: the scene as a whole
    BenchSettings settings{};
    std::string why{};
    Loss loss = Loss::none; ///< if not none, it was tried, and the run fails
    std::string axis{};     ///< of growth, if it was measured along one
};

/// The machine that measured.
struct BenchMachine {
    std::string processor{}; ///< as it names itself
    std::uint64_t cores = 0;
    std::string system{}; ///< operating system and architecture
};

struct BenchRun {
    std::string version{};
    DriverInfo gl{};
    std::string embree{};
    BenchMachine machine{};
    std::vector<std::string> arguments{}; ///< what all points were measured with
    std::vector<BenchScene> scenes{};
    std::vector<BenchPoint> points{};
    std::vector<BenchLeftOut> left_out{};
    std::vector<Growth> growth{};
    bool finished = false;
};

/// "normalise=cube-map bumps=derivatives"; empty where there are none.
std::string words_of(const BenchSettings& settings);

/// The run's point of that scene, technique and settings; null where there is none.
const BenchPoint* find_point(const BenchRun& run, const BenchPoint& like);

} // namespace shadowproof
