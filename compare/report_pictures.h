// The pictures of a report as values, and the one way in which they become PNG files.
#pragma once

#include "compare/report.h"
#include "compare/report_legend.h"

#include <filesystem>

namespace shadowproof {

/// The dimmed claim with each differing pixel in the colour of its contradiction.
Image<Rgb> difference_picture(const GroundTruth& truth, const Cell& cell);

/// The dimmed claim with each differing pixel in the colour of its cause.
Image<Rgb> cause_picture(const Cell& cell);

/// 8-bit gray, or RGB; the same bytes for the same picture. Throws Error naming the file.
void write_png(const std::filesystem::path& file, const Image<Visibility>& classes);
void write_png(const std::filesystem::path& file, const Image<Rgb>& picture);

/// Truth once, and claim, difference and cause of each cell that ran, into `report`, at the paths
/// of truth_path and picture_path. threads 0: one per core.
void write_pictures(const SceneResult& scene, const std::filesystem::path& report, int threads);

} // namespace shadowproof
