// manifest.json: the list of files that this program wrote into a folder. Only listed files that
// have not changed since are ever removed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace shadowproof {

/// Size and hash of a written file, to tell whether it has changed.
struct Fingerprint {
    std::uint64_t size = 0; ///< bytes
    std::string xxh3;       ///< XXH3 of 128 bits (xxhash.com), seed 0, canonical, in hexadecimal

    bool operator==(const Fingerprint&) const = default;
};

/// The fingerprint of bytes that come in parts.
class GrowingFingerprint {
public:
    GrowingFingerprint();
    void add(std::string_view bytes);
    Fingerprint so_far() const;

private:
    std::shared_ptr<void> state_; ///< the hash's
    std::uint64_t size_ = 0;
};

Fingerprint fingerprint_of(std::string_view bytes);
/// Of a regular file. Throws std::system_error where it cannot be read.
Fingerprint fingerprint_of(const std::filesystem::path& file);

/// Files by their names: relative to the folder, with slashes. The manifest itself is not listed.
using Manifest = std::map<std::string, Fingerprint, std::less<>>;

inline constexpr const char* manifest_name = "manifest.json";

/// Whether a name is valid in a manifest: relative, of printable bytes, and never leading out of
/// the folder.
bool is_name_below(std::string_view name);

/// Whether a manifest lists the regular file `file` as `name`, and it has not changed since. Throws
/// std::system_error where it cannot be read.
bool is_as_listed(const Manifest& manifest, std::string_view name,
                  const std::filesystem::path& file);

/// manifest.json of schema shadowproof/manifest/1.
std::string to_json(const Manifest& manifest);

/// The manifest of `folder`; none if there is none, or if this program did not write it. Throws
/// std::system_error if that cannot be determined.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);

/// Whether the manifest lists a file below `folder`, given as a name in the manifest.
bool lists_below(const Manifest& manifest, std::string_view folder);

} // namespace shadowproof
