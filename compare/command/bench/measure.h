// Measures the points of a benchmark: each technique and setting on each scene, error and time.
#pragma once

#include "compare/command/bench/keeper.h"
#include "compare/command/bench/options.h"
#include "compare/command/pieces/pieces.h"
#include "compare/command/point_pictures.h"
#include "compare/command/process/console.h"
#include "raster/gl/context.h"

namespace shadowproof {

/// What measuring a scene needs besides it.
struct BenchWork {
    const BenchOptions& options;
    Gpu& gpu;
    Console& console;
    Pieces& pieces;
    BenchRun& run;        ///< grows
    const BenchRun* kept; ///< an earlier run to go on with; null: none
    BenchKeeper& keeper;
    PointPictures* pictures = nullptr; ///< null: none are kept
};

/// The truth is computed once and shared by all points. Each is drawn once to warm up, and judged
/// by that; then all are measured in rounds. Techniques that cannot be drawn, and settings that the
/// scene does not admit, are left out and said, and so are points in which a worker was lost.
/// Returns whether all that was asked for was measured, but for points that took too long. Throws
/// Error if the scene cannot be read.
bool measure_scene(const BenchWork& work, const std::string& argument);

} // namespace shadowproof
