// Alpha masks of materials (alphaMode MASK). Textures are read only of materials that some mesh of
// the scene has, and that leave something out.
#pragma once

#include "scenes/load/gltf/material.h"

#include <vector>

namespace shadowproof::gltf {

/// Fills scene.masks, the materials' `mask`, the coordinates of their textures, and left_out, where
/// a mask leaves nothing standing. Materials are opaque that have another mode, whose mask leaves
/// nothing out, or whose texture is in a format that is not read; the notes say so. `used`: one
/// flag per material of the file. Throws Error.
void read_masks(const Document& document, const std::vector<bool>& used, Materials& materials,
                Scene& scene);

} // namespace shadowproof::gltf
