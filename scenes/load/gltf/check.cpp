#include "scenes/load/gltf/check.h"

#include "scenes/load/gltf/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

void require(bool holds, const json& value, const Place& place, const char* kind) {
    if (!holds)
        place.refuse(fmt::format("is {}, not {}", value.type_name(), kind),
                     fmt::format("write {}", kind));
}

double number(const json& value, const Place& place) {
    require(value.is_number(), value, place, "a number");
    return value.get<double>(); // always finite: JSON has no other
}

std::uint64_t integer(const json& value, const Place& place, std::uint64_t least,
                      std::uint64_t most) {
    const double real = number(value, place);
    const bool is_unsigned = value.is_number_unsigned();
    const bool fits = is_unsigned || (real >= 0 && real < 0x1p53 && std::trunc(real) == real);
    const std::uint64_t result = !fits         ? 0
                                 : is_unsigned ? value.get<std::uint64_t>()
                                               : static_cast<std::uint64_t>(real);
    if (!fits || result < least || result > most)
        place.refuse(fmt::format("{} is not an integer from {} to {}", value.dump(), least, most),
                     "write one");
    return result;
}

/// Elements of the array at a JSON pointer; 0 where there is none.
std::size_t count_at(const json& root, const char* array) {
    const json::json_pointer pointer(array);
    return root.contains(pointer) ? root.at(pointer).size() : 0;
}

void check_numbers(const json& value, const Place& place, std::size_t count) {
    require(value.is_array(), value, place, "an array");
    if (value.size() != count)
        place.refuse(fmt::format("has {} elements, not {}", value.size(), count),
                     fmt::format("write {} numbers", count));
    for (std::size_t i = 0; i < count; ++i) number(value[i], place / i);
}

void check_component_type(const json& value, const Place& place) {
    const std::uint64_t type = integer(value, place, 0, 0xffff);
    if (type < 5120 || type > 5126 || type == 5124)
        place.refuse(fmt::format("{} is no component type", type),
                     "use 5120 to 5123, 5125 or 5126");
}

void check_accessor_type(const json& value, const Place& place) {
    constexpr std::array types{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    require(value.is_string(), value, place, "a string");
    if (std::find(types.begin(), types.end(), value) == types.end())
        place.refuse(fmt::format("{} is no accessor type", value.dump()), "use \"VEC3\"");
}

/// Checks one rule on everything its path reaches.
class Checker {
public:
    Checker(const Rule& rule, const json& root)
        : rule_(rule), count_(rule.kind == Kind::index ? count_at(root, rule.array) : 0) {}

    void walk(json& value, const Place& place, std::string_view path) const {
        if (path.empty()) return check(value, place);
        const std::string_view step = path.substr(0, path.find('/'));
        const std::string_view rest = path.substr(std::min(step.size() + 1, path.size()));
        if (step == "*") {
            require(value.is_array(), value, place, "an array");
            for (std::size_t i = 0; i < value.size(); ++i) walk(value[i], place / i, rest);
            return;
        }
        require(value.is_object(), value, place, "an object");
        if (step == "{}") {
            for (const auto& [key, member] : value.items()) walk(member, place / key, rest);
            return;
        }
        walk_member(value, place, step, rest);
    }

private:
    void walk_member(json& value, const Place& place, std::string_view step,
                     std::string_view rest) const {
        const bool required = step.back() == '!';
        const bool only_object = step.back() == '?';
        if (required || only_object) step.remove_suffix(1);
        const auto member = value.find(step);
        if (member == value.end()) {
            if (required)
                place.refuse(fmt::format("\"{}\" is missing", step),
                             "add it; glTF 2.0 requires it");
        } else if (!only_object || member->is_object()) {
            walk(*member, place / step, rest);
        }
    }

    void check(json& value, const Place& place) const {
        switch (rule_.kind) {
        case Kind::text:
            return require(value.is_string(), value, place, "a string");
        case Kind::boolean:
            return require(value.is_boolean(), value, place, "a boolean");
        case Kind::number:
            number(value, place);
            return;
        case Kind::positive:
            if (!(number(value, place) > 0))
                place.refuse(value.dump() + " is not above 0", "write a positive number");
            return;
        case Kind::numbers:
            return check_numbers(value, place, rule_.most);
        case Kind::whole:
            value = integer(value, place, rule_.least, rule_.most);
            return;
        case Kind::index:
            return check_index(value, place);
        case Kind::component_type:
            check_component_type(value, place);
            value = integer(value, place, 0, 0xffff);
            return;
        case Kind::accessor_type:
            return check_accessor_type(value, place);
        }
    }

    void check_index(json& value, const Place& place) const {
        const std::uint64_t index = integer(value, place, rule_.least, rule_.most);
        if (index >= count_)
            place.refuse(fmt::format("{} is no index into {}, which has {}", index, rule_.array,
                                     count_ == 0 ? "none" : std::to_string(count_)),
                         "name an element that exists");
        value = index;
    }

    const Rule& rule_;
    std::size_t count_;
};

/// Whether an extension changes only the look of a surface: then the notes say that it is ignored.
bool is_only_look(std::string_view extension) {
    return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
           extension.starts_with("EXT_texture_") || extension == "MSFT_texture_dds" ||
           extension == "KHR_xmp_json_ld";
}

void check_version(const Place& root, const json& document) {
    const std::string version = document["asset"]["version"];
    if (!version.starts_with("2."))
        (root / "asset" / "version")
            .refuse(fmt::format("\"{}\" is not glTF 2", version), "convert the asset to glTF 2.0");
}

void check_required_extensions(const Place& root, const json& document) {
    const auto required = document.find("extensionsRequired");
    for (std::size_t i = 0; required != document.end() && i < required->size(); ++i) {
        const std::string name = (*required)[i];
        if (!is_evaluated(name) && !is_only_look(name))
            (root / "extensionsRequired" / i)
                .refuse(fmt::format("requires the extension {}, which is not evaluated", name),
                        "export the asset without it");
    }
}

/// tinygltf keeps the matrix and silently drops the rest.
void check_transforms(const Place& root, const json& document) {
    const auto nodes = document.find("nodes");
    for (std::size_t i = 0; nodes != document.end() && i < nodes->size(); ++i)
        for (const char* key : {"translation", "rotation", "scale"})
            if ((*nodes)[i].contains("matrix") && (*nodes)[i].contains(key))
                (root / "nodes" / i)
                    .refuse(fmt::format("has both \"matrix\" and \"{}\"", key), "keep one");
}

/// Whether Draco's stream takes the place of a primitive's buffer views.
bool is_compressed(const json& primitive) {
    return primitive.contains(json::json_pointer("/extensions/KHR_draco_mesh_compression"));
}

/// tinygltf does not load index accessors that have no buffer view, and does not say which.
void check_indices(const Place& root, const json& document) {
    const auto meshes = document.find("meshes");
    for (std::size_t i = 0; meshes != document.end() && i < meshes->size(); ++i) {
        const auto& primitives = (*meshes)[i]["primitives"];
        for (std::size_t k = 0; k < primitives.size(); ++k) {
            const auto indices = primitives[k].find("indices");
            if (indices == primitives[k].end() || is_compressed(primitives[k])) continue;
            if (!document["accessors"][indices->get<std::size_t>()].contains("bufferView"))
                (root / "meshes" / i / "primitives" / k / "indices")
                    .refuse("names an accessor without a buffer view", "give it one");
        }
    }
}

} // namespace

bool is_evaluated(std::string_view extension) {
    constexpr std::array evaluated{
        "EXT_mesh_gpu_instancing",    "KHR_node_visibility",     "KHR_texture_transform",
        "KHR_materials_variants",     "KHR_lights_punctual",     "KHR_mesh_quantization",
        "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression",
    };
    return std::find(evaluated.begin(), evaluated.end(), extension) != evaluated.end();
}

void check_json(const Place& root, json& document) {
    for (const Rule& rule : rules_of_the_head)
        Checker(rule, document).walk(document, root, rule.path);
    check_version(root, document);
    check_required_extensions(root, document);
    for (const Rule& rule : rules) Checker(rule, document).walk(document, root, rule.path);
    check_transforms(root, document);
    check_indices(root, document);
}

void check_lighting(const Place& root, json& document) {
    for (const Rule& rule : rules_of_lighting)
        Checker(rule, document).walk(document, root, rule.path);
}

} // namespace shadowproof::gltf
