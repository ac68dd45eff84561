// Mesh primitives to world-space triangles: morph targets and skins applied, strips and fans
// unrolled, winding restored where a node mirrors.
#pragma once

#include "scenes/load/gltf/accessor.h"
#include "scenes/load/gltf/nodes.h"
#include "scenes/scene.h"

namespace shadowproof::gltf {

/// Appends the meshes of every node of the scene, in the order of graph.in_scene, after
/// place_nodes. Positions are transformed once, in double, and rounded once, to float. Also fills
/// scene.materials and, where one of them has a bump map, scene.surfaces and what else lighting
/// needs; otherwise none of that is read. `normals`: scene.normals are filled. Throws Error, also
/// for a file without any triangle.
void bake_meshes(AccessorReader& reader, const NodeGraph& graph, bool normals, Scene& scene);

} // namespace shadowproof::gltf
