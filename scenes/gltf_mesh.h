// Mesh primitives to world-space triangles: morph targets and skins applied, strips and fans
// unrolled, winding restored where a node mirrors.
#pragma once

#include "scenes/gltf_accessor.h"
#include "scenes/gltf_nodes.h"
#include "scenes/scene.h"

namespace shadowproof::gltf {

/// Appends the meshes of every node of the scene, in the order of graph.in_scene, which place_nodes
/// has placed. Positions are transformed once, in double, and rounded once, to float. Also fills
/// scene.materials and, where one of them has a bump map, scene.surfaces and what else lighting
/// needs; where none has, none of it is looked at. Throws Error; a file without a single triangle
/// is one.
void bake_meshes(AccessorReader& reader, const NodeGraph& graph, Scene& scene);

} // namespace shadowproof::gltf
