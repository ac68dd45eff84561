// Scenes of any size, for measuring how time grows with it.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// About `triangles` triangles: balls with waves on them, all but closed, over a floor, an ordinary
/// light above.
Scene dense_scene(int triangles, int width, int height);

/// Closed plates above each other under the light, in the number given: the shadows on the floor
/// lie in as many shadow volumes, and the eye in none.
Scene stacked_scene(int plates, int width, int height);

/// Some 60,000 triangles over a floor, in as many smooth closed balls as the number given, a power
/// of four up to 1024: the more balls, the more silhouette edges.
Scene parted_scene(int balls, int width, int height);

/// Five balls of some 10,000 triangles together, and above them a circle of lights, in the number
/// given.
Scene lit_scene(int lights, int width, int height);

} // namespace shadowproof
