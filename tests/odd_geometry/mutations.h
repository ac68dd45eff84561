// Scenes with odd numbers in them: a few coordinates, vertices, triangles, the eye or the light
// replaced, as a broken exporter, a broken file or an unlucky pose would.
#pragma once

#include "scenes/scene.h"
#include "tests/dice.h"

#include <string>
#include <vector>

namespace shadowproof::tests {

/// A closed prism of six vertices, the first of the scene, over a floor; 28x24 pixels.
Scene prism_over_floor();

/// Small scenes to mutate: closed casters over a floor, and the smallest of the bundled ones.
std::vector<Scene> scenes_to_mutate();

/// Mutates a scene by one to three steps; says in words what was done.
std::vector<std::string> mutate(Scene& scene, Dice& dice);

/// Whether all vertices that are used, the eye, the near plane and the lights are finite.
bool is_finite(const Scene& scene);

} // namespace shadowproof::tests
