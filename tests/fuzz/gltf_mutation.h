// Mutations of a glTF asset: of its JSON tree, its geometry and its bytes.
#pragma once

#include "tests/dice.h"
#include "tests/fuzz/asset.h"

namespace shadowproof::fuzz {

/// One change that mostly leaves a scene that loads: a vertex, a triangle, the place of a node, the
/// light or the camera.
void move_scene(Asset& asset, Dice& dice);

/// One change anywhere: the above, the JSON tree, or bytes of a buffer.
void mutate_gltf(Asset& asset, Dice& dice);

} // namespace shadowproof::fuzz
