// The truth as a mean over the pixel, by more and more rays: what filtering bumps costs and gains.
#pragma once

#include "compare/bench/bench_run.h"
#include "reference/predict/traced_scene.h"
#include "reference/shade/shading.h"

#include <vector>

namespace shadowproof {

/// Rays along each side of a pixel, in the order of their cost; the last is what the others are
/// held against. 1 to 1024 rays a pixel; `quick`: to 64.
std::vector<int> sampled_sides(bool quick);

/// {"samples", "16"} for 4 rays along each side, and back; 0 where the settings have no samples.
BenchSettings samples_setting(int side);
int side_of(const BenchSettings& settings);

/// How far the first is off the second, over pixels that surfaces cover wholly in the second;
/// colours as a screen shows them, between 0 and 1.
BenchColor color_distance(const Supersampled& picture, const Supersampled& yardstick);

/// A point like `truth`, of the same scene, for each of the sides: its error of colours is its
/// distance from the last one, which has a sample of time already.
std::vector<BenchPoint> judge_sampled(const TracedScene& traced, const BenchPoint& truth,
                                      const std::vector<int>& sides);

} // namespace shadowproof
