#include "compare/output/manifest.h"

#include "compare/output/descriptor.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* schema = "shadowproof/manifest/1";
/// Enough for a million files. A larger one was not written by this program.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28U;

std::string hexadecimal(XXH128_hash_t hash) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, hash);
    std::string text;
    for (const unsigned char byte : canonical.digest) text += fmt::format("{:02x}", byte);
    return text;
}

/// Whether an error means that there is no such file, or none that this program would have written:
/// not there, a link, a folder or a device, too large. After other errors it is unknown.
bool is_no_manifest(int reason) {
    return reason == ENOENT || reason == ENOTDIR || reason == ELOOP || reason == EINVAL ||
           reason == ENXIO || reason == EFBIG;
}

std::optional<std::pair<std::string, Fingerprint>> entry_of(const Json& json) {
    if (!json.is_object() || !json.contains("name") || !json.contains("size") ||
        !json.contains("xxh3"))
        return std::nullopt;
    const Json& name = json.at("name");
    const Json& size = json.at("size");
    const Json& xxh3 = json.at("xxh3");
    if (!name.is_string() || !size.is_number_unsigned() || !xxh3.is_string() ||
        !is_name_below(name.get_ref<const std::string&>()))
        return std::nullopt;
    return std::pair(name.get<std::string>(),
                     Fingerprint{size.get<std::uint64_t>(), xxh3.get<std::string>()});
}

} // namespace

GrowingFingerprint::GrowingFingerprint()
    : state_(XXH3_createState(),
             [](void* state) { XXH3_freeState(static_cast<XXH3_state_t*>(state)); }) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_.get()));
}

void GrowingFingerprint::add(std::string_view bytes) {
    XXH3_128bits_update(static_cast<XXH3_state_t*>(state_.get()), bytes.data(), bytes.size());
    size_ += bytes.size();
}

Fingerprint GrowingFingerprint::so_far() const {
    return {size_, hexadecimal(XXH3_128bits_digest(static_cast<XXH3_state_t*>(state_.get())))};
}

Fingerprint fingerprint_of(std::string_view bytes) {
    return {bytes.size(), hexadecimal(XXH3_128bits(bytes.data(), bytes.size()))};
}

Fingerprint fingerprint_of(const fs::path& file) {
    GrowingFingerprint fingerprint;
    read_pieces(file, [&](std::string_view piece) { fingerprint.add(piece); });
    return fingerprint.so_far();
}

bool is_name_below(std::string_view name) {
    const auto is_control = [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    };
    if (name.empty() || std::any_of(name.begin(), name.end(), is_control)) return false;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const std::string_view part = name.substr(begin, end - begin);
        if (part.empty() || part == "." || part == "..") return false;
        begin = end + 1;
    }
    return true;
}

std::string to_json(const Manifest& manifest) {
    Json json{{"schema", schema}, {"version", SHADOWPROOF_VERSION}, {"files", Json::array()}};
    for (const auto& [name, fingerprint] : manifest)
        json["files"].push_back(
            {{"name", name}, {"size", fingerprint.size}, {"xxh3", fingerprint.xxh3}});
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Manifest> read_manifest(const fs::path& folder) {
    std::string text;
    try {
        read_pieces(folder / manifest_name, [&](std::string_view piece) {
            if (text.size() > most_bytes) throw std::system_error(EFBIG, std::generic_category());
            text += piece;
        });
    } catch (const std::system_error& error) {
        if (!is_no_manifest(error.code().value())) throw;
        return std::nullopt;
    }
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("schema") || json.at("schema") != schema ||
        !json.contains("files") || !json.at("files").is_array())
        return std::nullopt;
    Manifest manifest;
    for (const Json& file : json.at("files")) {
        auto entry = entry_of(file);
        if (!entry) return std::nullopt;
        manifest.insert(std::move(*entry));
    }
    return manifest;
}

bool is_as_listed(const Manifest& manifest, std::string_view name, const fs::path& file) {
    const auto entry = manifest.find(name);
    return entry != manifest.end() && fs::is_regular_file(fs::symlink_status(file)) &&
           fingerprint_of(file) == entry->second;
}

bool lists_below(const Manifest& manifest, std::string_view folder) {
    const std::string prefix = std::string(folder) + "/";
    const auto first = manifest.lower_bound(prefix);
    return first != manifest.end() && first->first.starts_with(prefix);
}

} // namespace shadowproof
