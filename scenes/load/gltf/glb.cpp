#include "scenes/load/gltf/glb.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

namespace shadowproof::gltf {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

namespace {

std::string_view as_text(std::span<const unsigned char> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint32_t word_at(std::span<const unsigned char> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

constexpr std::uint32_t glb_magic = 0x46546C67;    // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;   // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942; // "BIN\0"

bool is_glb(std::span<const unsigned char> bytes) {
    return bytes.size() >= 4 && word_at(bytes, 0) == glb_magic;
}

} // namespace

Chunks split_chunks(const Place& root, std::span<const unsigned char> bytes) {
    if (bytes.empty()) root.refuse("is empty", "export the asset again, or check its download");
    if (!is_glb(bytes)) return {as_text(bytes), std::nullopt};
    const auto refuse = [&](const std::string& what) {
        root.refuse("GLB " + what, "export the asset again");
    };
    if (bytes.size() < 12) refuse("ends inside its header");
    if (word_at(bytes, 4) != 2) refuse(fmt::format("has version {}, not 2", word_at(bytes, 4)));
    if (word_at(bytes, 8) != bytes.size())
        refuse(fmt::format("says it has {} bytes but has {}", word_at(bytes, 8), bytes.size()));
    Chunks chunks;
    std::size_t offset = 12;
    for (std::size_t number = 0; offset < bytes.size(); ++number) {
        if (bytes.size() - offset < 8)
            refuse(fmt::format("ends inside the header of chunk {}", number));
        const std::size_t length = word_at(bytes, offset);
        const std::uint32_t type = word_at(bytes, offset + 4);
        offset += 8;
        if (length > bytes.size() - offset)
            refuse(fmt::format("chunk {} has {} bytes but {} are left", number, length,
                               bytes.size() - offset));
        if ((number == 0) != (type == json_chunk))
            refuse("must have one JSON chunk, and it must be the first");
        if (number == 0) chunks.json = as_text(bytes.subspan(offset, length));
        if (number == 1 && type == binary_chunk) chunks.binary = bytes.subspan(offset, length);
        offset += length;
    }
    if (chunks.json.empty()) refuse("has no JSON chunk");
    return chunks;
}

} // namespace shadowproof::gltf
