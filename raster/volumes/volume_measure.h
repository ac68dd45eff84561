// A picture of the shadow volumes, and how many fragments they fill.
#pragma once

#include "raster/passes/passes.h"
#include "raster/volumes/volume_pass.h"
#include "scenes/frame.h"

#include <functional>

namespace shadowproof {

/// Sets volumes and volume_fragments of a frame whose depths are in the target: how many faces are
/// not behind each pixel's surface, summed without sorting; and how many fragments all faces have,
/// by an occlusion query without depth test. `draw_volumes` draws all faces of the passes given;
/// the target needs its sum.
void measure_volumes(const GlFunctions& gl, const Target& target, const DepthModel& depth_model,
                     std::span<const VolumePass* const> passes,
                     const std::function<void()>& draw_volumes, Frame& frame);

} // namespace shadowproof
