#include "scenes/gltf_file.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <span>

namespace shadowproof::gltf {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

std::vector<std::byte> read_bytes(const std::filesystem::path& file, const std::string& where,
                                  std::optional<std::uint64_t> first) {
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status))
        throw Error(where, fmt::format("\"{}\" does not exist", file.string()), "check the path");
    if (!std::filesystem::is_regular_file(status))
        throw Error(where, fmt::format("\"{}\" is not a regular file", file.string()),
                    "name a file");
    const std::uint64_t size = std::filesystem::file_size(file, failure);
    if (failure || first.value_or(size) > limits.bytes)
        throw Error(where,
                    fmt::format("\"{}\" has more than {} bytes", file.string(), limits.bytes),
                    "split the asset");
    std::vector<std::byte> bytes(std::min(size, first.value_or(size)));
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()),
                     static_cast<std::streamsize>(bytes.size())))
        throw Error(where, fmt::format("\"{}\" cannot be read", file.string()),
                    "check its permissions");
    return bytes;
}

namespace {

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Nesting and number of values, counted on the raw text before any of it becomes memory. Inside
/// malformed JSON the counts mean nothing, but the parser then stops there.
void scan_json(const std::string& file, std::string_view json) {
    std::uint64_t depth = 0;
    std::uint64_t values = 1;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
            continue;
        }
        in_string = c == '"';
        if (c == '{' || c == '[') {
            ++depth;
            ++values;
        }
        if ((c == '}' || c == ']') && depth > 0) --depth;
        if (c == ',') ++values;
        if (depth > limits.json_depth)
            throw Error(file,
                        fmt::format("nests deeper than {} levels at byte {}", limits.json_depth, i),
                        "flatten the JSON");
        if (values > limits.json_values)
            throw Error(file, fmt::format("holds more than {} JSON values", limits.json_values),
                        "move the bulk into buffers");
    }
}

nlohmann::json parse_json(const std::string& file, std::string_view text) {
    if (text.size() > limits.json_bytes)
        throw Error(
            file, fmt::format("has {} bytes of JSON, more than {}", text.size(), limits.json_bytes),
            "move the bulk into .bin buffers");
    scan_json(file, text);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        throw Error(file, fmt::format("is not JSON ({})", error.what()), "export the asset again");
    }
}

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

/// The two chunks of a GLB that matter (glTF 2.0, section 4.4).
struct Chunks {
    std::span<const std::byte> json;
    std::optional<std::span<const std::byte>> binary;
};

constexpr std::uint32_t glb_magic = 0x46546C67;    // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;   // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942; // "BIN\0"

bool is_glb(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && word_at(bytes, 0) == glb_magic;
}

Chunks split_glb(const std::string& file, std::span<const std::byte> bytes) {
    const auto refuse = [&](const std::string& what) {
        throw Error(file, "GLB " + what, "export the asset again");
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
        if (number == 0) chunks.json = bytes.subspan(offset, length);
        if (number == 1 && type == binary_chunk) chunks.binary = bytes.subspan(offset, length);
        offset += length;
    }
    if (chunks.json.empty()) refuse("has no JSON chunk");
    return chunks;
}

std::vector<std::byte> read_data_uri(const Item& uri, std::string_view text) {
    constexpr std::string_view marker = ";base64,";
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || comma + 1 < marker.size() ||
        text.substr(comma + 1 - marker.size(), marker.size()) != marker)
        uri.refuse("is a data URI that is not base64", "encode it as base64");
    auto bytes = decode_base64(text.substr(comma + 1));
    if (!bytes) uri.refuse("is not well-formed base64", "export the asset again");
    return std::move(*bytes);
}

/// The first `length` bytes, or as many as there are.
std::vector<std::byte> read_buffer(const Item& buffer, std::uint64_t length,
                                   const std::filesystem::path& folder,
                                   std::optional<std::span<const std::byte>> binary) {
    const auto uri = buffer.find("uri");
    if (!uri) {
        if (!binary) buffer.refuse("has no uri and there is no GLB chunk for it", "add the uri");
        const auto first = binary->first(std::min<std::size_t>(length, binary->size()));
        return {first.begin(), first.end()};
    }
    const std::string text = uri->text();
    if (text.starts_with("data:")) return read_data_uri(*uri, text);
    return read_bytes(resolve_uri(folder, *uri), uri->where(), length);
}

void read_buffers(Document& document, const std::filesystem::path& folder,
                  std::optional<std::span<const std::byte>> binary) {
    const Item root = document.root();
    const std::size_t count = count_of(root, "buffers");
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Item buffer = root.at("buffers")[i];
        const std::uint64_t length = buffer.at("byteLength").whole(1, 1ULL << 53);
        total += length;
        if (length > limits.bytes || total > limits.bytes)
            buffer.at("byteLength")
                .refuse(fmt::format("brings the buffers above {} bytes", limits.bytes),
                        "split the asset");
        document.buffers.push_back(
            read_buffer(buffer, length, folder, i == 0 ? binary : std::nullopt));
        if (document.buffers.back().size() < length)
            buffer.at("byteLength")
                .refuse(fmt::format("is {} but the buffer has {} bytes", length,
                                    document.buffers.back().size()),
                        "restore the missing bytes");
        document.buffers.back().resize(length);
    }
}

} // namespace

Document read_document(const std::filesystem::path& file) {
    Document document{file.string(), {}, {}};
    const std::vector<std::byte> bytes = read_bytes(file, document.file);
    Chunks chunks{bytes, std::nullopt};
    if (is_glb(bytes)) chunks = split_glb(document.file, bytes);
    document.json = parse_json(document.file, as_text(chunks.json));
    const std::string version = document.root().at("asset").at("version").text();
    if (!version.starts_with("2."))
        document.root().at("asset").at("version").refuse(
            fmt::format("\"{}\" is not glTF 2", version), "convert the asset to glTF 2.0");
    read_buffers(document, file.parent_path(), chunks.binary);
    return document;
}

} // namespace shadowproof::gltf
