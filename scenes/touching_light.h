// Casters so near the light that the floats of a graphics pipeline do not tell on which side of
// them it is.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// The casting triangles, in rising order, whose corners' directions from the light surround it
/// once each is off by what floats round: whichever half of the sky the triangle then covers, seen
/// from the light, is chance. None where the light is directional.
std::vector<std::uint32_t> triangles_touching_light(const Scene& scene);

} // namespace shadowproof
