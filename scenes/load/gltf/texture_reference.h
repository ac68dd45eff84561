// What a material says of a texture: whether it can be read, and which coordinates it has.
#pragma once

#include "scenes/load/gltf/material.h"

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>

namespace shadowproof::gltf {

/// The member at a path of objects; null where there is none.
const nlohmann::json& find(const nlohmann::json& value, std::initializer_list<const char*> path);

/// Whether a texture has no image but one in a format that another extension allows. `look`: the
/// document's; `index`: of the texture, which need not be one.
bool is_unread(const nlohmann::json& look, const nlohmann::json& index);

/// Of a textureInfo, checked by check_lighting.
Coordinates read_coordinates(const nlohmann::json& texture);

} // namespace shadowproof::gltf
