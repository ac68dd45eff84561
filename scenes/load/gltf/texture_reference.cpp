#include "scenes/load/gltf/texture_reference.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace shadowproof::gltf {

using nlohmann::json;

const json& find(const json& value, std::initializer_list<const char*> path) {
    static const json none;
    const json* at = &value;
    for (const char* key : path) {
        if (!at->is_object() || !at->contains(key)) return none;
        at = &(*at)[key];
    }
    return *at;
}

bool is_unread(const json& look, const json& index) {
    const json& textures = find(look, {"textures"});
    if (!index.is_number_unsigned() || !textures.is_array() || index >= textures.size())
        return false; // check_lighting tells of it
    const json& texture = textures[index.get<std::size_t>()];
    if (!texture.is_object() || texture.contains("source")) return false;
    const auto has = [&](const char* name) {
        return !find(texture, {"extensions", name}).is_null();
    };
    return has("EXT_texture_webp") || has("KHR_texture_basisu") || has("EXT_texture_avif") ||
           has("MSFT_texture_dds");
}

/// v of a texture runs down, so a rotation that looks counter-clockwise takes u to u cos, -u sin.
Coordinates read_coordinates(const json& texture) {
    Coordinates coordinates{texture.value("texCoord", std::size_t{0})};
    const json& ours = find(texture, {"extensions", "KHR_texture_transform"});
    if (ours.is_null()) return coordinates;
    coordinates.set = ours.value("texCoord", coordinates.set);
    const auto offset = ours.value("offset", std::array{0.0, 0.0});
    const auto scale = ours.value("scale", std::array{1.0, 1.0});
    const double angle = ours.value("rotation", 0.0); // radians
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    coordinates.transform = glm::dmat3(c * scale[0], -s * scale[0], 0, s * scale[1], c * scale[1],
                                       0, offset[0], offset[1], 1);
    return coordinates;
}

} // namespace shadowproof::gltf
