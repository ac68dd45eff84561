// Scenes of any size, for measuring how time grows with it.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// About `triangles` triangles: closed balls with waves on them over a floor, an ordinary light
/// above.
Scene dense_scene(int triangles, int width, int height);

/// So many closed plates above each other under the light: the shadows on the floor lie in as many
/// shadow volumes, and the eye in none.
Scene stacked_scene(int plates, int width, int height);

/// 73,728 triangles in so many balls, a power of four up to 1024, over a floor: twice the
/// silhouette edges or so for each four times the balls.
Scene parted_scene(int balls, int width, int height);

/// Five balls of 10,000 triangles together, and so many lights in a circle above them.
Scene lit_scene(int lights, int width, int height);

} // namespace shadowproof
