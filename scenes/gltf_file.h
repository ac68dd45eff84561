// Bytes of a .gltf or .glb file and of its buffers. Sizes, nesting and chunks are checked before
// memory is taken; URIs stay inside the asset's folder; images are never read.
#pragma once

#include "scenes/gltf_json.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowproof::gltf {

/// What one asset may ask for. Far above what a verifier is used on, far below what would exhaust
/// a machine: a JSON value takes some 50 bytes, a baked vertex 12, a triangle 12.
struct Limits {
    std::uint64_t bytes = 1ULL << 30;       ///< of the file, and of all its buffers together
    std::uint64_t json_bytes = 1ULL << 28;  ///< 256 MiB
    std::uint64_t json_values = 1ULL << 22; ///< 4 million
    std::uint64_t json_depth = 64;          ///< nested objects and arrays
    std::uint64_t elements = 1ULL << 26;    ///< accessor elements read, all reads together
    std::uint64_t triangles = 1ULL << 24;   ///< baked, all nodes together; vertices as many
};
inline constexpr Limits limits;

struct Document {
    std::string file; ///< as given, for messages
    nlohmann::json json;
    std::vector<std::vector<std::byte>> buffers; ///< one each of /buffers, at least byteLength

    Item root() const { return {file, json}; }
};

/// Throws Error.
Document read_document(const std::filesystem::path& file);

/// The place in the asset's folder that a relative URI names, percent-encoding undone. Refuses
/// (at `uri`) absolute paths, schemes, and whatever leaves the folder, through links as well.
std::filesystem::path resolve_uri(const std::filesystem::path& folder, const Item& uri);

/// All bytes of a file, or the first ones (as many as there are). Throws Error naming `where`: not
/// a regular file, unreadable, beyond limits.bytes.
std::vector<std::byte> read_bytes(const std::filesystem::path& file, const std::string& where,
                                  std::optional<std::uint64_t> first = std::nullopt);

/// The bytes of base64 text (RFC 4648, section 4); nothing where it is malformed.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

} // namespace shadowproof::gltf
