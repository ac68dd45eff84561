// The pictures of a report as values, and as files.
#pragma once

#include "compare/png.h"
#include "compare/report.h"
#include "compare/report_legend.h"

#include <filesystem>

namespace shadowproof {

/// The dimmed claim with each differing pixel in the colour of its contradiction.
PalettePicture difference_picture(const GroundTruth& truth, const Cell& cell);

/// The dimmed claim with each differing pixel in the colour of its cause.
PalettePicture cause_picture(const Cell& cell);

/// Packs the cause maps and writes truth once, and claim, difference and cause of each cell that
/// ran, into `report`, at the paths of truth_path and picture_path. threads 0: one per core.
void write_pictures(SceneResult& scene, const std::filesystem::path& report, int threads);

} // namespace shadowproof
