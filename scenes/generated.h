// Scenes of any size, for measuring how time grows with it.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// About `triangles` triangles: wavy balls, almost closed, over a floor and under an ordinary
/// light.
Scene dense_scene(int triangles, int width, int height);

/// That many closed plates, one above the other, under the light: the shadows on the floor lie in
/// as many shadow volumes, and the eye lies in none.
Scene stacked_scene(int plates, int width, int height);

/// About 60,000 triangles over a floor, divided among that many smooth closed balls (a power of
/// four, up to 1024): the more balls, the more silhouette edges.
Scene parted_scene(int balls, int width, int height);

/// Five balls with about 10,000 triangles together, under a circle of that many lights.
Scene lit_scene(int lights, int width, int height);

} // namespace shadowproof
