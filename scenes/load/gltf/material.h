// Materials: alpha mask, colour, bump map, and what extras.shadowproof says of them. But for masks,
// textures are read only where some mesh of the scene is bump-mapped.
#pragma once

#include "scenes/load/gltf/nodes.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <vector>

namespace shadowproof::gltf {

/// Where a texture's coordinates come from: a set of the mesh, transformed as KHR_texture_transform
/// says.
struct Coordinates {
    std::size_t set = 0;
    glm::dmat3 transform{1.0}; ///< of (u, v, 1)
};

/// The coordinates of a material's textures.
struct CoordinateSets {
    Coordinates decal;
    Coordinates bump;
    Coordinates mask;
};

/// What else is read of the materials, by index into Scene::materials.
struct Materials {
    bool bump_lit = false; ///< some mesh of the scene has a material with a bump map
    std::vector<CoordinateSets> sets;
    std::vector<bool> left_out; ///< by their masks, altogether
};

/// Where a texture that lighting needs is in a format that is not read (WebP, KTX2), no surface is
/// lit by bump maps, and scene.notes says why. Fills scene.materials (those of the file, followed
/// by the default one, glTF 2.0, section 3.7.2.1), scene.masks and, where bump_lit, scene.textures,
/// ambient, inverse_square and environment. Throws Error.
Materials read_materials(const Document& document, const NodeGraph& graph, Scene& scene);

} // namespace shadowproof::gltf
