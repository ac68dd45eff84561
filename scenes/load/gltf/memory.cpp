#include "scenes/load/gltf/memory.h"

#include "scenes/load/gltf/nodes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

constexpr std::uint64_t heap_block = 16;   // malloc's own, and its rounding
constexpr std::uint64_t short_string = 15; // up to this many characters take no block
/// A growing vector holds its old half while it moves into twice as much.
constexpr std::uint64_t growth = 3;

/// Of a node of std::map: its colour and three pointers.
constexpr std::uint64_t tree_node = 32 + heap_block;

} // namespace

JsonCounts count_json(std::string_view text, std::uint64_t deepest) {
    JsonCounts counts{.bytes = text.size(), .too_deep_at = std::nullopt};
    std::uint64_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
            continue;
        }
        in_string = c == '"';
        counts.strings += in_string ? 1 : 0;
        counts.members += c == ':' ? 1 : 0;
        if (c == '{' || c == '[') {
            ++depth;
            ++counts.containers;
            ++counts.values;
        }
        if ((c == '}' || c == ']') && depth > 0) --depth;
        if (c == ',') ++counts.values;
        if (depth > deepest) {
            counts.too_deep_at = i;
            break;
        }
    }
    return counts;
}

std::uint64_t json_bytes(const JsonCounts& counts) {
    constexpr std::uint64_t container = sizeof(json::object_t) + heap_block;
    // A node of a map, or an element of a vector that grows.
    constexpr std::uint64_t pair = sizeof(std::string) + sizeof(json);
    constexpr std::uint64_t member = std::max(tree_node + pair, growth * pair);
    constexpr std::uint64_t text = sizeof(std::string) + short_string + 2 * heap_block;
    return growth * sizeof(json) * counts.values + container * counts.containers +
           member * counts.members + text * counts.strings + 2 * counts.bytes;
}

std::uint64_t model_bytes(const json& document, const JsonCounts& counts) {
    const std::pair<const char*, std::uint64_t> elements[] = {
        {"buffers", sizeof(tinygltf::Buffer)},
        {"bufferViews", sizeof(tinygltf::BufferView)},
        {"accessors", sizeof(tinygltf::Accessor)},
        {"meshes", sizeof(tinygltf::Mesh)},
        {"nodes", sizeof(tinygltf::Node) + sizeof(Node) + 4 * sizeof(std::size_t)},
        {"scenes", sizeof(tinygltf::Scene)},
        // Plus three maps with a few parameters each.
        {"materials", sizeof(tinygltf::Material) + 8 * (tree_node + sizeof(tinygltf::Parameter))},
        {"animations", sizeof(tinygltf::Animation)},
        {"skins", sizeof(tinygltf::Skin)},
        {"cameras", sizeof(tinygltf::Camera)}};
    std::uint64_t bytes = 0;
    std::uint64_t containers = counts.containers;
    for (const auto& [array, size] : elements) {
        const std::uint64_t count = document.contains(array) ? document[array].size() : 0;
        bytes += count * (growth * size + heap_block);
        containers -= std::min(containers, count);
    }
    // What lies below is never more than one of these for each container or member of the JSON.
    constexpr std::uint64_t below =
        growth * std::max({sizeof(tinygltf::Primitive), sizeof(tinygltf::AnimationSampler),
                           sizeof(tinygltf::AnimationChannel)});
    constexpr std::uint64_t entry =
        tree_node + sizeof(std::string) + growth * sizeof(tinygltf::Value);
    return bytes + below * containers + entry * counts.members +
           growth * sizeof(tinygltf::Value) * counts.strings +
           growth * sizeof(double) * counts.values;
}

} // namespace shadowproof::gltf
