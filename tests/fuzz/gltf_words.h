// Names and strings that glTF or shadowproof give a meaning.
#pragma once

#include <span>
#include <string_view>

namespace shadowproof::fuzz {

std::span<const std::string_view> gltf_words();

} // namespace shadowproof::fuzz
