// The pictures of one scene, judged: what a worker of `check` does.
#pragma once

#include "compare/command/check/options.h"
#include "compare/command/process/console.h"
#include "compare/results/baseline.h"

#include <optional>
#include <span>

namespace shadowproof {

/// The name of a renderer's cells where none is given.
inline constexpr const char* usual_name = "renderer";

/// What a worker is given.
struct CheckWork {
    const CheckOptions& options;
    const SceneInputs& inputs;
    const std::optional<ResultsFile>& baseline;
    MemoryAccount& memory;
    Console& console;
    const ReportFolder& folder;
    std::span<const SceneResult> done; ///< scenes before this one
    Pieces& pieces;
};

/// The scene with a cell for each picture. Throws Error where nothing can be told by this view.
SceneResult check_scene(const CheckWork& work);

} // namespace shadowproof
