// The table of relations, by what they change.
#pragma once

#include "scenes/relations/relation.h"

#include <vector>

namespace shadowproof {

/// Of where everything is: moved, scaled, turned, mirrored.
std::vector<Relation> motions();
/// Of how the same surfaces are written down: permuted, split, joined, subdivided.
std::vector<Relation> mesh_changes();

} // namespace shadowproof
