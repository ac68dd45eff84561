#include "tests/fuzz/mutants.h"

#include "tests/fuzz/gltf_mutation.h"
#include "tests/fuzz/png_mutation.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

namespace shadowproof::fuzz {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_bytes = 2'000'000;

FileBytes bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void embed_pictures(Asset& asset, const fs::path& folder) {
    const auto images = asset.json.find("images");
    if (images == asset.json.end() || !images->is_array()) return;
    for (json& image : *images) {
        if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string()) continue;
        const auto uri = image["uri"].get<std::string>();
        if (uri.starts_with("data:") || !fs::is_regular_file(folder / uri)) continue;
        image["uri"] = "data:image/png;base64," + base64(bytes_of(folder / uri));
    }
}

/// What a bundled scene says it provokes, its mutant need not.
void drop_declarations(json& tree) {
    const json::json_pointer ours("/extras/shadowproof");
    if (tree.contains(ours) && tree[ours].is_object()) tree[ours].erase("provokes");
}

FileBytes in_one_file(const fs::path& file) {
    FileBytes bytes = bytes_of(file);
    auto asset = read_asset(bytes);
    if (!asset) return bytes;
    embed_files(*asset, file.parent_path());
    embed_pictures(*asset, file.parent_path());
    drop_declarations(asset->json);
    return written(*asset);
}

void flip_bytes(FileBytes& bytes, Dice& dice) {
    if (bytes.empty()) return;
    switch (dice.below(6)) {
    case 0: // a run left out
        bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(dice.below(
                                                       std::min<std::size_t>(bytes.size(), 64))));
        return;
    case 1: // cut off
        return bytes.resize(dice.below(bytes.size()));
    case 2: { // a word that is an offset, a count or a float
        static constexpr std::array<std::uint32_t, 8> words{
            0, 1, 0xffffffff, 0x7fffffff, 0x80000000, 0x7f800000, 0x7f7fffff, 0x00000001};
        const std::size_t at =
            dice.below(dice.one_in(2) ? std::min<std::size_t>(bytes.size(), 80) : bytes.size());
        const std::uint32_t word = dice.one_of(words);
        for (std::size_t k = 0; k < 4 && at / 4 * 4 + k < bytes.size(); ++k)
            bytes[at / 4 * 4 + k] = static_cast<std::uint8_t>(word >> (8 * k));
        return;
    }
    default:
        for (std::size_t n = 1 + dice.below(8); n > 0; --n) {
            std::uint8_t& byte = dice.one_of(bytes);
            byte = dice.one_in(2) ? static_cast<std::uint8_t>(dice.bits())
                                  : static_cast<std::uint8_t>(byte ^ (1U << dice.below(8)));
        }
    }
}

FileBytes mutated_picture(const FileBytes& bytes, Dice& dice) {
    auto chunks = dice.one_in(6) ? std::nullopt : read_png(bytes);
    if (!chunks) {
        FileBytes flipped = bytes;
        flip_bytes(flipped, dice);
        return flipped;
    }
    for (std::size_t n = 1 + dice.below(2); n > 0; --n) mutate_png(*chunks, dice);
    return written(*chunks);
}

/// One of the pictures that the asset embeds.
void mutate_pictures(Asset& asset, Dice& dice) {
    const auto images = asset.json.find("images");
    if (images == asset.json.end() || !images->is_array() || images->empty()) return;
    json& image = (*images)[dice.below(images->size())];
    if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string()) return;
    const auto uri = image["uri"].get<std::string>();
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) return;
    image["uri"] = uri.substr(0, comma + 1) +
                   base64(mutated_picture(from_base64(uri.substr(comma + 1)), dice));
}

FileBytes mutated_gltf(const FileBytes& bytes, Dice& dice) {
    auto asset = dice.one_in(6) ? std::nullopt : read_asset(bytes);
    if (!asset) {
        FileBytes flipped = bytes;
        flip_bytes(flipped, dice);
        return flipped;
    }
    const std::size_t way = dice.below(10);
    for (std::size_t n = 1 + dice.below(4); n > 0; --n)
        if (way < 5)
            move_scene(*asset, dice);
        else if (way < 9)
            mutate_gltf(*asset, dice);
        else
            mutate_pictures(*asset, dice);
    return written(*asset);
}

} // namespace

std::vector<Original> originals_in(std::span<const fs::path> folders) {
    static const std::set<std::string> kinds{".gltf", ".glb", ".md2", ".png"};
    std::set<fs::path> files; // in order
    for (const fs::path& folder : folders)
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && kinds.contains(entry.path().extension().string()))
                files.insert(entry.path());
    std::vector<Original> originals;
    for (const fs::path& file : files) {
        const std::string extension = file.extension().string();
        FileBytes bytes = extension.starts_with(".gl") ? in_one_file(file) : bytes_of(file);
        if (bytes.size() <= most_bytes) originals.push_back({extension, std::move(bytes)});
    }
    if (originals.empty()) throw std::runtime_error("no assets in the folders given");
    return originals;
}

FileBytes mutated(const Original& original, Dice& dice) {
    if (original.extension == ".png") return mutated_picture(original.bytes, dice);
    if (original.extension.starts_with(".gl")) return mutated_gltf(original.bytes, dice);
    FileBytes bytes = original.bytes;
    for (std::size_t n = 1 + dice.below(3); n > 0; --n) flip_bytes(bytes, dice);
    return bytes;
}

} // namespace shadowproof::fuzz
