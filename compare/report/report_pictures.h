// The pictures of a report as values, and as files.
#pragma once

#include "compare/output/replaced_folder.h"
#include "compare/report/png.h"
#include "compare/report/report.h"
#include "compare/report/report_legend.h"
#include "compare/report/shared_files.h"

namespace shadowproof {

/// The dimmed claim with each pixel that contradicts the truth in the colour of its contradiction.
PalettePicture difference_picture(const GroundTruth& truth, const Cell& cell);

/// The dimmed claim with each differing pixel in the colour of its cause.
PalettePicture cause_picture(const Cell& cell);

/// Where a cell's picture stands if no earlier one is the same, and its data, relative to the
/// report's folder.
std::string own_path(const SceneResult& scene, const Cell& cell, const std::string& kind);
std::string script_path(const SceneResult& scene, const Cell& cell);

/// Writes the truth, at truth_path, and the data that the cells share into `report`.
void write_scene(const SceneResult& scene, const FolderPart& report);
/// Packs the cause map of a cell that ran, and writes its pictures, at picture_path, and its data;
/// what earlier cells of the scene have too is not written again, where it is known. threads 0: one
/// per core.
void write_cell(const SceneResult& scene, Cell& cell, const FolderPart& report, Memo& memo,
                SharedFiles* shared, int threads);

} // namespace shadowproof
