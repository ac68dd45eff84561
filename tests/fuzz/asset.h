// A glTF asset taken apart for mutation: its JSON, and its buffers' bytes. Reads more than glTF
// allows, as what is mutated is mutated again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof::fuzz {

using FileBytes = std::vector<std::uint8_t>;

struct Asset {
    nlohmann::json json;
    /// Of json["buffers"], by index; none where a buffer is neither embedded nor GLB's.
    std::vector<std::optional<FileBytes>> buffers;
    bool binary = false; ///< a GLB, whose first buffer is its chunk
};

/// None where the bytes are no JSON, or a GLB whose chunks cannot be found.
std::optional<Asset> read_asset(std::span<const std::uint8_t> bytes);

/// Buffers that the folder's files hold become embedded ones, so that the asset is one file.
void embed_files(Asset& asset, const std::filesystem::path& folder);

/// The file's bytes again. Its buffers' URIs hold what `buffers` says; byteLength stays as it is.
FileBytes written(const Asset& asset);

std::string base64(std::span<const std::uint8_t> bytes);
/// What is no digit is skipped.
FileBytes from_base64(std::string_view digits);

} // namespace shadowproof::fuzz
