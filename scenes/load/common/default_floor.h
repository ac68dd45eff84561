// The floor under a model whose file has no camera or no light: a shadow needs something to fall
// on.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// Appends a square that receives shadows and casts none: a hundredth of the bounding sphere's
/// radius below the lowest vertex, four radii wide to each side of its middle. Not under a room
/// (room.h), which has a floor, and not where its corners would be beyond what is admitted.
/// scene.notes says so.
void add_default_floor(Scene& scene);

} // namespace shadowproof
