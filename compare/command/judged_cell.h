// A technique drawn on a traced scene, and judged.
#pragma once

#include "compare/cell.h"
#include "raster/gl/context.h"
#include "raster/technique.h"
#include "reference/predict/traced_scene.h"

namespace shadowproof {

struct JudgedCell {
    Cell cell;
    double evidence_milliseconds = 0; ///< spent on Cell::evidence
};

/// `evidence`: whether to find what a report shows of it. Throws Error where the technique cannot
/// draw the scene, or draws nothing where something is seen.
JudgedCell judged_cell(const Technique& technique, const TracedScene& traced, const Plan& plan,
                       Gpu& gpu, bool evidence);

} // namespace shadowproof
