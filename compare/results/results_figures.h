// The figures of results.json against each other: sums, cause maps, the paths of pictures.
#pragma once

#include "compare/json/json_place.h"

namespace shadowproof {

/// Check the figures and paths of a cell, or a scene, whose members are as the schema says. Throw
/// Error.
void check_cell_figures(const JsonPlace& cell, const ResultsJson& scene);
void check_scene_figures(const JsonPlace& scene);

} // namespace shadowproof
