#include "tests/fuzz/asset.h"

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>

namespace shadowproof::fuzz {

namespace {

using nlohmann::json;

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::string_view embedded = "data:application/octet-stream;base64,";

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

void put_word(FileBytes& bytes, std::uint32_t word) {
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(word >> (8 * k)));
}

std::optional<json> parsed(std::span<const std::uint8_t> text) {
    // The parser recurses no deeper than the text nests.
    std::size_t depth = 0;
    for (const std::uint8_t c : text) {
        if (c == '[' || c == '{') ++depth;
        if ((c == ']' || c == '}') && depth > 0) --depth;
        if (depth > 200) return std::nullopt;
    }
    json tree = json::parse(text.begin(), text.end(), nullptr, false);
    if (!tree.is_object()) return std::nullopt;
    return tree;
}

json* buffers_of(json& tree) {
    const auto found = tree.find("buffers");
    return found != tree.end() && found->is_array() ? &*found : nullptr;
}

const std::string* uri_of(const json& buffer) {
    const auto found = buffer.is_object() ? buffer.find("uri") : buffer.end();
    return buffer.is_object() && found != buffer.end() && found->is_string()
               ? &found->get_ref<const std::string&>()
               : nullptr;
}

std::optional<Asset> read_glb(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 20) return std::nullopt;
    const std::size_t length = word_at(bytes, 12);
    if (length > bytes.size() - 20) return std::nullopt;
    auto tree = parsed(bytes.subspan(20, length));
    if (!tree) return std::nullopt;
    Asset asset{std::move(*tree), {}, true};
    const auto rest = bytes.subspan(20 + length);
    if (rest.size() > 8) asset.buffers.emplace_back(FileBytes(rest.begin() + 8, rest.end()));
    return asset;
}

void append_chunk(FileBytes& glb, const char* type, FileBytes content, std::uint8_t padding) {
    while (content.size() % 4 != 0) content.push_back(padding);
    put_word(glb, static_cast<std::uint32_t>(content.size()));
    glb.insert(glb.end(), type, type + 4);
    glb.insert(glb.end(), content.begin(), content.end());
}

} // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

FileBytes from_base64(std::string_view text) {
    std::array<std::int8_t, 256> value{};
    value.fill(-1);
    for (std::size_t i = 0; i < digits.size(); ++i)
        value[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
    FileBytes bytes;
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : text) {
        const int digit = value[static_cast<unsigned char>(c)];
        if (digit < 0) continue;
        group = group << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::uint8_t>(group >> bits));
        }
    }
    return bytes;
}

std::optional<Asset> read_asset(std::span<const std::uint8_t> bytes) {
    std::optional<Asset> asset;
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
        asset = read_glb(bytes);
    } else if (auto tree = parsed(bytes)) {
        asset = Asset{std::move(*tree), {}, false};
    }
    if (!asset) return std::nullopt;
    if (json* buffers = buffers_of(asset->json)) {
        asset->buffers.resize(std::max(buffers->size(), asset->buffers.size()));
        for (std::size_t i = 0; i < buffers->size(); ++i)
            if (const std::string* uri = uri_of((*buffers)[i]); uri && uri->starts_with("data:"))
                asset->buffers[i] = from_base64(
                    std::string_view(*uri).substr(std::min(uri->find(',') + 1, uri->size())));
    }
    return asset;
}

void embed_files(Asset& asset, const std::filesystem::path& folder) {
    json* buffers = buffers_of(asset.json);
    if (buffers == nullptr) return;
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        const std::string* uri = uri_of((*buffers)[i]);
        if (uri == nullptr || uri->starts_with("data:")) continue;
        std::ifstream file(folder / *uri, std::ios::binary);
        if (!file) continue;
        asset.buffers[i] = FileBytes(std::istreambuf_iterator<char>(file), {});
        (*buffers)[i]["uri"] = std::string(embedded);
    }
}

FileBytes written(const Asset& asset) {
    json tree = asset.json;
    json* buffers = buffers_of(tree);
    for (std::size_t i = 0; buffers != nullptr && i < buffers->size(); ++i)
        if (const std::string* uri = uri_of((*buffers)[i]);
            uri && uri->starts_with("data:") && i < asset.buffers.size() && asset.buffers[i])
            (*buffers)[i]["uri"] = uri->substr(0, uri->find(',') + 1) + base64(*asset.buffers[i]);
    const std::string text = tree.dump(-1, ' ', false, json::error_handler_t::replace);
    const FileBytes content(text.begin(), text.end());
    if (!asset.binary) return content;
    FileBytes chunks;
    append_chunk(chunks, "JSON", content, ' ');
    if (!asset.buffers.empty() && asset.buffers[0])
        append_chunk(chunks, "BIN\0", *asset.buffers[0], 0);
    FileBytes glb{'g', 'l', 'T', 'F'};
    put_word(glb, 2);
    put_word(glb, static_cast<std::uint32_t>(12 + chunks.size()));
    glb.insert(glb.end(), chunks.begin(), chunks.end());
    return glb;
}

} // namespace shadowproof::fuzz
