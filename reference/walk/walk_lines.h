// Rays in the walk's frame, in double, and Embree's own rays made of them. Those begin where a ray
// enters the scene's box, so that neither a distant eye nor a distant light takes anything from
// their precision.
#pragma once

#include "reference/walk/box_tree.h"

namespace shadowproof {

/// Rays p + s w, 1 <= |w| < 2 in the largest component, for s from begin to end.
struct WalkLines {
    Vectors p;
    Vectors w;
    alignas(64) Lanes<double> begin{};
    alignas(64) Lanes<double> end{};
};

/// Sets the walk's rays, but for `lanes`, and the s at which each starts. A ray that
/// misses the scene's box, and half as much around it, reaches none but the boxes that hold
/// everything.
void cut_to_scene(const WalkLines& lines, WalkRays& rays, Lanes<double>& start);

} // namespace shadowproof
