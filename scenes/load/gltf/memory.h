// Upper bounds on the memory that a glTF document takes, computed before it is allocated.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace shadowproof::gltf {

/// The sizes of a JSON text.
struct JsonCounts {
    std::uint64_t values = 1;               ///< of any kind
    std::uint64_t containers = 0;           ///< objects and arrays
    std::uint64_t members = 0;              ///< of objects
    std::uint64_t strings = 0;              ///< keys among them
    std::uint64_t bytes = 0;                ///< of the text
    std::optional<std::size_t> too_deep_at; ///< the byte at which it nests deeper than is allowed
};

/// The counts of a text that nests at most `deepest` levels, else up to where it goes deeper. For
/// malformed JSON the counts are meaningless, but a parser stops there.
JsonCounts count_json(std::string_view text, std::uint64_t deepest);

/// Bytes of nlohmann's values of such a text, at most, while they are read or copied; also for
/// objects that keep their members' order (ordered_json).
std::uint64_t json_bytes(const JsonCounts& counts);

/// Bytes of tinygltf's model of a document and of what else is made of each element, without the
/// buffers' bytes.
std::uint64_t model_bytes(const nlohmann::json& document, const JsonCounts& counts);

} // namespace shadowproof::gltf
