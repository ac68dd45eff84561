// Where the far ends of volumes lie that are extruded to a finite distance. Reference and
// rasterizer share it, since these very floats are drawn.
#pragma once

#include "scenes/scene.h"
#include "scenes/technique_settings.h"

#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// Half the diagonal of the bounding box: what an engine might use that knows only the size of its
/// scene. Enough under a high light, too short under a low one.
double finite_extrusion(const Scene& scene);
/// The length that was asked for, in world units, or else that half diagonal. Throws Error naming
/// the flag where it is further than coordinates may be (largest_coordinate).
double finite_extrusion(const Scene& scene, const VolumeSettings& asked);

/// Each position moved by `distance` world units away from the chosen light, rounded to float.
std::vector<glm::vec3> extruded_positions(const Scene& scene, double distance);

} // namespace shadowproof
