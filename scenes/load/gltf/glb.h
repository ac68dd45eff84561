// GLB: a glTF asset's JSON and binary data in one file (glTF 2.0, section 4.4).
#pragma once

#include "scenes/load/common/place.h"

#include <optional>
#include <span>
#include <string_view>

namespace shadowproof::gltf {

/// The two parts of an asset's file: a .gltf is JSON alone.
struct Chunks {
    std::string_view json;
    std::optional<std::span<const unsigned char>> binary;
};

/// Views of `bytes`. tinygltf's own GLB reader checks neither the version nor the total length, and
/// reads 8 bytes past a last chunk that is too short, so the chunks are split here.
Chunks split_chunks(const Place& root, std::span<const unsigned char> bytes);

} // namespace shadowproof::gltf
