#include "tests/fuzz/gltf_elements.h"

#include <cstring>
#include <utility>
#include <vector>

namespace shadowproof::fuzz {

namespace {

using nlohmann::json;

std::size_t unsigned_of(const json& object, const char* key, std::size_t otherwise) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end() || !found->is_number_unsigned())
        return otherwise;
    return found->get<std::size_t>();
}

const json* element(const json& tree, const char* array, std::size_t index) {
    const auto found = tree.find(array);
    return found != tree.end() && found->is_array() && index < found->size() ? &(*found)[index]
                                                                             : nullptr;
}

std::size_t component_bytes(std::size_t type) {
    switch (type) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    default:
        return 4;
    }
}

std::size_t components_of(const json& accessor) {
    const std::pair<const char*, std::size_t> types[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const auto found = accessor.find("type");
    for (const auto& [name, count] : types)
        if (found != accessor.end() && *found == name) return count;
    return 1;
}

/// Accessors that primitives name as `attribute`, or as their indices where it is "indices".
std::vector<std::size_t> accessors_named(const json& tree, const std::string& attribute) {
    std::vector<std::size_t> found;
    const auto meshes = tree.find("meshes");
    if (meshes == tree.end() || !meshes->is_array()) return found;
    for (const json& mesh : *meshes) {
        if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array())
            continue;
        for (const json& primitive : mesh["primitives"]) {
            if (!primitive.is_object()) continue;
            const bool indices = attribute == "indices";
            if (!indices && !primitive.contains("attributes")) continue;
            const json& holder = indices ? primitive : primitive["attributes"];
            const std::size_t index = unsigned_of(holder, attribute.c_str(), ~std::size_t{0});
            if (index != ~std::size_t{0}) found.push_back(index);
        }
    }
    return found;
}

} // namespace

std::optional<Elements> elements_of(Asset& asset, std::size_t index) {
    constexpr std::size_t none = ~std::size_t{0};
    const json* accessor = element(asset.json, "accessors", index);
    if (accessor == nullptr || !accessor->is_object()) return std::nullopt;
    const json* view =
        element(asset.json, "bufferViews", unsigned_of(*accessor, "bufferView", none));
    if (view == nullptr) return std::nullopt;
    const std::size_t buffer = unsigned_of(*view, "buffer", none);
    if (buffer >= asset.buffers.size() || !asset.buffers[buffer]) return std::nullopt;
    FileBytes& bytes = *asset.buffers[buffer];
    const std::size_t type = unsigned_of(*accessor, "componentType", 5126);
    Elements elements{nullptr, unsigned_of(*accessor, "count", 0), components_of(*accessor),
                      component_bytes(type), type == 5126};
    const std::size_t view_offset = unsigned_of(*view, "byteOffset", 0);
    const std::size_t offset = unsigned_of(*accessor, "byteOffset", 0);
    if (elements.count == 0 || elements.count > bytes.size() || view_offset > bytes.size() ||
        offset > bytes.size() - view_offset ||
        elements.count * elements.bytes() > bytes.size() - view_offset - offset)
        return std::nullopt;
    elements.first = bytes.data() + view_offset + offset;
    return elements;
}

std::optional<Elements> some_accessor(Asset& asset, const std::string& attribute, Dice& dice) {
    std::vector<std::size_t> all = accessors_named(asset.json, attribute);
    return all.empty() ? std::nullopt : elements_of(asset, dice.one_of(all));
}

float float_at(const Elements& of, std::size_t number) {
    float value = 0;
    std::memcpy(&value, of.first + number * sizeof value, sizeof value);
    return value;
}

void set_float(const Elements& of, std::size_t number, float value) {
    std::memcpy(of.first + number * sizeof value, &value, sizeof value);
}

void copy_element(const Elements& of, std::size_t to, std::size_t from) {
    std::memmove(of.first + to * of.bytes(), of.first + from * of.bytes(), of.bytes());
}

std::uint32_t index_at(const Elements& of, std::size_t number) {
    std::uint32_t value = 0;
    std::memcpy(&value, of.first + number * of.component_bytes, of.component_bytes);
    return value;
}

void set_index(const Elements& of, std::size_t number, std::uint32_t value) {
    std::memcpy(of.first + number * of.component_bytes, &value, of.component_bytes);
}

} // namespace shadowproof::fuzz
