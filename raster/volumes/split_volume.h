// Shadow volumes of casters that touch the light, with additional corners at their far ends
// (scenes/mesh/split_far_ends.h): dark caps become fans, and a side over an edge that touches the
// light becomes two quarter planes, one on either side of the direction to the edge's nearest
// point.
#pragma once

#include "raster/volumes/volume.h"
#include "scenes/mesh/split_far_ends.h"

#include <cstdint>

namespace shadowproof {

/// Splits the far ends of an extruder's volumes, which must end at infinity. `first`: the number of
/// the corner along the first of `split.directions`. Returns the extruder itself where nothing is
/// split.
Extruder with_split_far_ends(Extruder extruder, const Scene& casters, const SplitFarEnds& split,
                             std::uint32_t first);

} // namespace shadowproof
