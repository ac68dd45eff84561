// Materials: colour, bump map, and what extras.shadowproof says of them. Textures are read only
// where some mesh of the scene is bump-mapped.
#pragma once

#include "scenes/load/gltf/nodes.h"
#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof::gltf {

/// The texture coordinate sets that a material's textures name.
struct CoordinateSets {
    std::size_t decal = 0;
    std::size_t bump = 0;
};

/// What else is read of the materials, by index into Scene::materials.
struct Materials {
    bool bump_lit = false; ///< some mesh of the scene has a material with a bump map
    std::vector<CoordinateSets> sets;
};

/// Fills scene.materials (those of the file, followed by the default one, glTF 2.0, section
/// 3.7.2.1) and, where bump_lit, scene.textures, ambient, inverse_square and environment. Throws
/// Error.
Materials read_materials(const Document& document, const NodeGraph& graph, Scene& scene);

} // namespace shadowproof::gltf
