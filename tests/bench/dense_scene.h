// Scenes of any number of triangles for measurements: balls with waves on them over a floor.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// About `triangles` triangles, closed balls over a floor, an ordinary light above.
Scene dense_scene(int triangles, int width, int height);

} // namespace shadowproof
