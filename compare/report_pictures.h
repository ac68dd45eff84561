// The pictures of a report as values, and as files.
#pragma once

#include "compare/output/replaced_folder.h"
#include "compare/png.h"
#include "compare/report.h"
#include "compare/report_legend.h"

namespace shadowproof {

/// The dimmed claim with each pixel that contradicts the truth in the colour of its contradiction.
PalettePicture difference_picture(const GroundTruth& truth, const Cell& cell);

/// The dimmed claim with each differing pixel in the colour of its cause.
PalettePicture cause_picture(const Cell& cell);

/// The dimmed claim, and over it the faces of the volumes that nothing hides, added up: the most of
/// them that lie at one pixel, or six, are the full colour.
PalettePicture volume_picture(const Cell& cell);

/// How far colours are from the truth, the lighter the further: eight shades an octave, from a
/// 256th of a step of 1/255 on. What is beyond its bound, or unforeseen, has its cause's colour.
PalettePicture color_error_picture(const ColorCheck& colors);

/// Writes the truth, at truth_path and color_path, and the data that the cells share into `report`.
void write_scene(const SceneResult& scene, const ReplacedFolder& report);
/// Packs the cause map of a cell that ran, and writes its pictures, at picture_path, and its data.
/// threads 0: one per core.
void write_cell(const SceneResult& scene, Cell& cell, const ReplacedFolder& report, int threads);

} // namespace shadowproof
