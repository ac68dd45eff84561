// A scene in other units: all lengths times a power of two.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// Whether all lengths times 2^power are exact, and none becomes a denormal.
bool scales_exactly(const Scene& scene, int power);

/// All lengths times a power of two, of camera, lights and vertices; Scene::unit follows. The light
/// that arrives stays the same.
void scale(Scene& scene, double factor);

} // namespace shadowproof
