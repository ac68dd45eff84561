// Checks a glTF file's JSON before tinygltf parses it. tinygltf drops values of a wrong type, folds
// large integers and takes any index; after these checks its model is what the file says.
#pragma once

#include "scenes/load/common/place.h"

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace shadowproof::gltf {

/// Refuses, at its JSON pointer, whatever we read that is missing, of the wrong type, out of range
/// or no index, and any required extension that is not evaluated. Integers written with a fraction
/// of zero (3.0), which glTF allows and tinygltf drops, become integers.
void check_json(const Place& root, nlohmann::json& document);

/// The same for what lighting by bump maps, and alpha masks, read: materials, textures, samplers
/// and images, and the root's extras.
void check_lighting(const Place& root, nlohmann::json& document);

/// Whether an extension is evaluated in full.
bool is_evaluated(std::string_view extension);

} // namespace shadowproof::gltf
