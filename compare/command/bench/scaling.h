// Measures how time grows: with pixels, triangles, shadow volumes crossed, silhouette edges,
// lights, and texels of shadow maps.
#pragma once

#include "compare/command/bench/measure.h"

namespace shadowproof {

/// Appends a Growth for each axis and technique to the run. Pixels and texels grow on the first
/// scene that was named (ordinary), the rest on generated ones; texels for shadow maps alone. A
/// technique that becomes too slow, or a size that needs too much memory, is left out from there
/// on, and the console says so. Returns whether nothing else failed.
bool measure_growth(const BenchWork& work);

} // namespace shadowproof
