// The far ends of volumes that are extruded by a finite distance. Reference and rasterizer share
// them, because these very floats are drawn.
#pragma once

#include "scenes/scene.h"
#include "scenes/technique_settings.h"

#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// Half the diagonal of the bounding box: an engine that knows only the size of its scene might use
/// it. Enough under a high light, too short under a low one.
double finite_extrusion(const Scene& scene);
/// The length that was asked for, in world units, or else that half diagonal. Throws Error naming
/// the flag where it exceeds largest_coordinate.
double finite_extrusion(const Scene& scene, const VolumeSettings& asked);

/// Each position moved by `distance` world units away from the chosen light, rounded to float.
std::vector<glm::vec3> extruded_positions(const Scene& scene, double distance);

} // namespace shadowproof
