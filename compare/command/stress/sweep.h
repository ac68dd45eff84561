// Takes a scene along the parameters, and judges every technique on the way.
#pragma once

#include "compare/command/pieces/pieces.h"
#include "compare/command/point_pictures.h"
#include "compare/command/process/console.h"
#include "compare/command/stress/options.h"
#include "compare/stress/stress_run.h"
#include "raster/gl/context.h"

#include <string>

namespace shadowproof {

/// What a sweep needs besides the scene.
struct StressWork {
    const StressOptions& options;
    Gpu& gpu;
    Console& console;
    Pieces& pieces;
    StressRun& run;                    ///< grows by scenes
    PointPictures* pictures = nullptr; ///< null: none are kept
};

/// The scene with a point for each value, and where techniques break, which is printed. A scene
/// that is refused or lost at some value, or a technique there, is said and ends nothing. Throws
/// Error if the scene cannot be read, or traced as it is.
StressScene stress_scene(const StressWork& work, const std::string& argument);

} // namespace shadowproof
