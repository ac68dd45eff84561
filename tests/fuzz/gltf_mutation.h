// Mutations of a glTF asset: of its JSON tree, its geometry and its bytes.
#pragma once

#include "tests/fuzz/asset.h"
#include "tests/fuzz/dice.h"

#include <span>
#include <string_view>

namespace shadowproof::fuzz {

/// Names and strings that glTF or shadowproof give a meaning.
std::span<const std::string_view> gltf_words();

/// One change that mostly leaves a scene that loads: a vertex, a triangle, the place of a node, the
/// light or the camera.
void move_scene(Asset& asset, Dice& dice);

/// One change anywhere: the above, the JSON tree, or bytes of a buffer.
void mutate_gltf(Asset& asset, Dice& dice);

} // namespace shadowproof::fuzz
