#include "tests/fuzz/gltf_mutation.h"

#include "tests/fuzz/gltf_elements.h"
#include "tests/fuzz/gltf_words.h"
#include "tests/fuzz/json_mutation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowproof::fuzz {

namespace {

using nlohmann::json;

void move_floats(const Elements& of, Dice& dice) {
    const std::size_t n = of.count * of.components;
    const std::size_t number = dice.below(n);
    switch (dice.below(10)) {
    case 0: // two elements become one
        return copy_element(of, dice.below(of.count), dice.below(of.count));
    case 1: { // a coordinate of some other element: faces come into one plane
        const std::size_t other = dice.below(of.count) * of.components + number % of.components;
        return set_float(of, number, float_at(of, other));
    }
    case 2: { // all of them scaled
        const int power = dice.one_in(4) ? static_cast<int>(dice.below(41)) - 20
                                         : static_cast<int>(dice.below(7)) - 3;
        for (std::size_t i = 0; i < n; ++i) set_float(of, i, std::ldexp(float_at(of, i), power));
        return;
    }
    case 3: { // far from the origin
        const float offset =
            std::ldexp(1.0F, static_cast<int>(dice.below(dice.one_in(4) ? 30 : 7)) - 5);
        for (std::size_t i = number % of.components; i < n; i += of.components)
            set_float(of, i, float_at(of, i) + offset);
        return;
    }
    case 4: // onto a lattice
        for (std::size_t i = 0; i < n; ++i) set_float(of, i, std::round(float_at(of, i) * 4) / 4);
        return;
    case 5: // flat, or thin
        for (std::size_t i = number % of.components; i < n; i += of.components)
            set_float(of, i, dice.one_in(2) ? float_at(of, number) : float_at(of, i) * 1e-6F);
        return;
    default:
        set_float(of, number, moved(float_at(of, number), dice));
    }
}

void move_triangles(const Elements& of, Dice& dice) {
    const std::size_t triangles = of.count / 3;
    if (triangles == 0) return;
    const std::size_t at = 3 * dice.below(triangles);
    switch (dice.below(5)) {
    case 0: // another vertex
        return set_index(of, at + dice.below(3), index_at(of, dice.below(of.count)));
    case 1: { // the other way round
        const std::uint32_t second = index_at(of, at + 1);
        set_index(of, at + 1, index_at(of, at + 2));
        return set_index(of, at + 2, second);
    }
    case 2: // twice, in the place of another
        for (std::size_t k = 0, to = 3 * dice.below(triangles); k < 3; ++k)
            set_index(of, to + k, index_at(of, at + k));
        return;
    case 3: // left out
        for (std::size_t k = 1; k < 3; ++k) set_index(of, at + k, index_at(of, at));
        return;
    default: // a neighbouring number
        set_index(of, at + dice.below(3), index_at(of, at) + 1);
    }
}

std::array<double, 4> some_rotation(Dice& dice) {
    if (dice.one_in(2)) { // by a multiple of 45 degrees about an axis
        const double half = 0.39269908169872414 * static_cast<double>(dice.below(9));
        std::array<double, 4> q{0, 0, 0, std::cos(half)};
        q[dice.below(3)] = std::sin(half);
        return q;
    }
    std::array<double, 4> q{};
    double square = 0;
    for (double& c : q) {
        c = static_cast<double>(dice.below(2001)) - 1000;
        square += c * c;
    }
    for (double& c : q) c = square > 0 ? c / std::sqrt(square) : 0.5;
    return q;
}

/// A vertex as the file has it: the world's, where nodes do not move it.
std::optional<json> some_vertex(Asset& asset, Dice& dice) {
    const auto positions = some_accessor(asset, "POSITION", dice);
    if (!positions || !positions->floating || positions->components != 3) return std::nullopt;
    const std::size_t at = dice.below(positions->count);
    json vertex = json::array();
    for (std::size_t k = 0; k < 3; ++k)
        vertex.push_back(static_cast<double>(float_at(*positions, 3 * at + k)));
    return vertex;
}

void move_node(Asset& asset, Dice& dice) {
    const auto nodes = asset.json.find("nodes");
    if (nodes == asset.json.end() || !nodes->is_array() || nodes->empty()) return;
    json& node = (*nodes)[dice.below(nodes->size())];
    if (!node.is_object() || node.contains("matrix")) return;
    switch (dice.below(6)) {
    case 0:
        node["rotation"] = some_rotation(dice);
        return;
    case 1:
        node["scale"] = {moved(1.0, dice), moved(1.0, dice), moved(1.0, dice)};
        return;
    case 2: // lights and eyes onto a vertex, or beside it
        if (auto vertex = some_vertex(asset, dice)) {
            if (dice.one_in(2)) {
                json& c = (*vertex)[dice.below(3)];
                c = moved(c.get<double>(), dice);
            }
            node["translation"] = *vertex;
        }
        return;
    default: {
        json& at = node["translation"];
        if (!at.is_array() || at.size() != 3) at = {0.0, 0.0, 0.0};
        json& c = at[dice.below(3)];
        c = moved(c.is_number() ? c.get<double>() : 0.0, dice);
    }
    }
}

/// A number of a camera, a light or a material, or a switch.
void move_setting(Asset& asset, Dice& dice) {
    static constexpr std::array arrays{"/cameras",   "/extensions/KHR_lights_punctual/lights",
                                       "/materials", "/extras",
                                       "/meshes",    "/nodes"};
    const json::json_pointer pointer(dice.one_of(arrays));
    if (!asset.json.contains(pointer)) return;
    std::vector<json*> numbers;
    for (json* value : values_of(asset.json[pointer]))
        if (value->is_number_float() || value->is_boolean()) numbers.push_back(value);
    if (!numbers.empty()) move_scalar(*dice.one_of(numbers), {}, dice);
}

void move_light(Asset& asset, Dice& dice) {
    const json::json_pointer pointer("/extensions/KHR_lights_punctual/lights/0");
    if (!asset.json.contains(pointer) || !asset.json[pointer].is_object()) return;
    static constexpr std::array kinds{"point", "spot", "directional"};
    json& light = asset.json[pointer];
    light["type"] = dice.one_of(kinds);
    light.erase("spot");
    if (light["type"] == "spot")
        light["spot"] = {{"innerConeAngle", 0.1},
                         {"outerConeAngle", 0.2 * (1.0 + static_cast<double>(dice.below(7)))}};
}

void flip_bytes(Asset& asset, Dice& dice) {
    if (asset.buffers.empty()) return;
    auto& buffer = dice.one_of(asset.buffers);
    if (!buffer || buffer->empty()) return;
    for (std::size_t n = 1 + dice.below(4); n > 0; --n)
        dice.one_of(*buffer) = static_cast<std::uint8_t>(dice.bits());
    if (dice.one_in(16)) buffer->resize(dice.below(buffer->size() + 1));
}

/// Exporters state bounds; a program may believe them. Without bounds nothing is stale.
void drop_bounds(json& tree) {
    const auto accessors = tree.find("accessors");
    if (accessors == tree.end() || !accessors->is_array()) return;
    for (json& accessor : *accessors)
        if (accessor.is_object()) {
            accessor.erase("min");
            accessor.erase("max");
        }
}

} // namespace

void move_scene(Asset& asset, Dice& dice) {
    drop_bounds(asset.json);
    switch (dice.below(10)) {
    case 0:
    case 1:
    case 2:
    case 3:
        if (const auto positions = some_accessor(asset, "POSITION", dice);
            positions && positions->floating)
            move_floats(*positions, dice);
        return;
    case 4: {
        static const std::array<std::string, 3> others{"NORMAL", "TANGENT", "TEXCOORD_0"};
        if (const auto other = some_accessor(asset, dice.one_of(others), dice);
            other && other->floating)
            move_floats(*other, dice);
        return;
    }
    case 5:
        if (const auto indices = some_accessor(asset, "indices", dice);
            indices && !indices->floating)
            move_triangles(*indices, dice);
        return;
    case 6:
        return move_setting(asset, dice);
    case 7:
        return dice.one_in(4) ? move_light(asset, dice) : move_node(asset, dice);
    default:
        return move_node(asset, dice);
    }
}

void mutate_gltf(Asset& asset, Dice& dice) {
    switch (dice.below(8)) {
    case 0:
    case 1:
        return move_scene(asset, dice);
    case 2:
        return flip_bytes(asset, dice);
    case 3: {
        // All accessors, the animations' and skins' too.
        const auto accessors = asset.json.find("accessors");
        if (accessors == asset.json.end() || !accessors->is_array() || accessors->empty()) return;
        const auto elements = elements_of(asset, dice.below(accessors->size()));
        if (!elements) return;
        return elements->floating ? move_floats(*elements, dice) : move_triangles(*elements, dice);
    }
    default:
        return mutate_json(asset.json, gltf_words(), dice);
    }
}

} // namespace shadowproof::fuzz
