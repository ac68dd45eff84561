// The table of parameters, by what they move.
#pragma once

#include "scenes/stress/parameter.h"

#include <vector>

namespace shadowproof {

/// Of camera and picture.
std::vector<StressParameter> view_parameters();
/// Of the light.
std::vector<StressParameter> light_parameters();
/// Of vertices and triangles, and of what is mapped onto them.
std::vector<StressParameter> geometry_parameters();
/// Of shadow maps: settings of techniques, not of the scene.
std::vector<StressParameter> map_parameters();
/// Of the sizes of triangles.
std::vector<StressParameter> triangle_parameters();

} // namespace shadowproof
