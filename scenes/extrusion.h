// Volumes extruded to a finite distance: where their far ends lie. Both sides read it here, since
// what is drawn are these very floats.
#pragma once

#include "scenes/scene.h"

#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// The distance that an engine would take that knows the size of its scene and no more: half the
/// diagonal of the bounding box. Enough under a high light, too short under a low one.
double finite_extrusion(const Scene& scene);

/// Each position moved by `distance` world units away from the chosen light, rounded to float.
std::vector<glm::vec3> extruded_positions(const Scene& scene, double distance);

} // namespace shadowproof
