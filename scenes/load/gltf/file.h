// A .gltf or .glb file as tinygltf's model. Sizes, nesting and every value are checked before
// tinygltf sees them; buffers are read through callbacks that stay inside the asset's folder;
// images are left to their readers (texture.h).
#pragma once

#include "scenes/limits.h"
#include "scenes/load/common/place.h"
#include "scenes/memory_budget.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof::gltf {

struct Document {
    std::string file; ///< as given, for messages
    /// As the file has it: every index is in range or -1 for none, every type and length as glTF
    /// says; each buffer holds at least its byteLength. Ranges within buffers are not checked yet.
    tinygltf::Model model;
    /// The root's extras; tinygltf's own copy lacks empty arrays, and "provokes": [] has a meaning.
    nlohmann::json extras;
    /// What lighting by bump maps reads: materials, textures, samplers, images, bufferViews and
    /// extras, as in the file, for check_lighting. tinygltf would decode every image, wanted or
    /// not.
    nlohmann::json look;
    std::filesystem::path folder; ///< of the asset
    /// The account of this file: what the document holds, and what is made of it.
    std::shared_ptr<MemoryAccount> memory = std::make_shared<MemoryAccount>();

    Place root() const { return Place(file); }
};

/// Throws Error, also where the budget does not suffice.
Document read_document(const std::filesystem::path& file, const MemoryBudget& budget = {});

/// A checked index of tinygltf's; it must not be -1.
inline std::size_t as_index(int index) {
    return static_cast<std::size_t>(index);
}

/// The file in the asset's folder that a relative URI names, percent-encoding undone. Refuses (at
/// `place`) absolute paths, schemes, and whatever leaves the folder, also through links.
std::filesystem::path resolve_uri(const std::filesystem::path& folder, const std::string& uri,
                                  const Place& place);

/// The digits of a base64 data URI, without padding. Refused at `place`: anything else.
std::string_view base64_digits(const std::string& uri, const Place& place);

} // namespace shadowproof::gltf
