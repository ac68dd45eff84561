// Scenes of any size, for measuring how time grows with it.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// About `triangles` triangles: balls with waves on them, all but closed, over a floor, an ordinary
/// light above.
Scene dense_scene(int triangles, int width, int height);

/// So many closed plates above each other under the light: the shadows on the floor lie in as many
/// shadow volumes, and the eye in none.
Scene stacked_scene(int plates, int width, int height);

/// Some 60,000 triangles in so many smooth closed balls, a power of four up to 1024, over a floor:
/// the more balls, the more silhouette edges.
Scene parted_scene(int balls, int width, int height);

/// Five balls of some 10,000 triangles together, and so many lights in a circle above them.
Scene lit_scene(int lights, int width, int height);

} // namespace shadowproof
