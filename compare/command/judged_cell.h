// A technique drawn on a traced scene, and judged.
#pragma once

#include "compare/cell.h"
#include "raster/gl/context.h"
#include "raster/technique.h"
#include "reference/predict/traced_scene.h"
#include "scenes/memory_budget.h"

#include <optional>

namespace shadowproof {

struct JudgedCell {
    Cell cell;
    double evidence_milliseconds = 0; ///< spent on Cell::evidence
    std::optional<double> strain{};   ///< Judge::strain
};

/// What is wanted besides the judgement.
struct Wanted {
    bool evidence = false; ///< what a report shows of it
    MemoryBudget memory{}; ///< of the whole run
    bool strain = false;
};

/// Throws Error where the technique cannot draw the scene, draws nothing where something is seen,
/// or has more to show than the memory holds.
JudgedCell judged_cell(const Technique& technique, const TracedScene& traced, const Plan& plan,
                       Gpu& gpu, const Wanted& wanted);

} // namespace shadowproof
