// Animations: the first of a file, evaluated at one time, sets node transforms and morph weights.
#pragma once

#include "scenes/load/gltf/accessor.h"
#include "scenes/load/gltf/nodes.h"

#include <string>
#include <vector>

namespace shadowproof::gltf {

/// Time in seconds; before the first and after the last key frame the nearest one holds, as glTF
/// says. With several animations the first is taken, and `notes` says so.
void pose_nodes(AccessorReader& reader, double time, NodeGraph& graph,
                std::vector<std::string>& notes);

} // namespace shadowproof::gltf
