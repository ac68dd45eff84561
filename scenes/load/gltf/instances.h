// EXT_mesh_gpu_instancing: a node's mesh placed many times, by translations, rotations and scales
// that are read from accessors.
#pragma once

#include "scenes/load/gltf/accessor.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace shadowproof::gltf {

/// A matrix per instance, from its space to the node's. One, the identity, where the node has no
/// instances. Refused: accessors that differ in count, a rotation without direction, a skin (the
/// extension does not say what that means), memory beyond the budget.
std::vector<glm::dmat4> read_instances(AccessorReader& reader, std::size_t node);

} // namespace shadowproof::gltf
