// The list of what this program wrote into a folder: manifest.json. Only what stands there, and is
// still what was written, is ever removed again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace shadowproof {

/// What was written: enough to tell whether it is still the same.
struct Fingerprint {
    std::uint64_t size = 0; ///< bytes
    std::string xxh3;       ///< XXH3 of 128 bits (xxhash.com), seed 0, canonical, in hexadecimal

    bool operator==(const Fingerprint&) const = default;
};

Fingerprint fingerprint_of(std::string_view bytes);
/// Of a regular file. Throws std::system_error where it cannot be read.
Fingerprint fingerprint_of(const std::filesystem::path& file);

/// Files by their names: relative to the folder, with slashes. The manifest itself is none of them.
using Manifest = std::map<std::string, Fingerprint, std::less<>>;

inline constexpr const char* manifest_name = "manifest.json";

/// Whether a name may stand in a manifest: relative, of printable bytes, and leading nowhere but
/// down.
bool is_name_below(std::string_view name);

/// manifest.json of schema shadowproof/manifest/1.
std::string to_json(const Manifest& manifest);

/// The manifest of `folder`; none where it has none, or one that this program did not write. Throws
/// std::system_error where that cannot be told.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);

/// Whether the manifest lists a file below `folder`, a name in it.
bool lists_below(const Manifest& manifest, std::string_view folder);

} // namespace shadowproof
