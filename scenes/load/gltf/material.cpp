#include "scenes/load/gltf/material.h"

#include "scenes/load/gltf/check.h"
#include "scenes/load/gltf/mask.h"
#include "scenes/load/gltf/texture.h"
#include "scenes/load/gltf/texture_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

const json& height_of(const json& material) {
    return find(material, {"extras", "shadowproof", "height"});
}

bool has_bump_map(const json& material) {
    return material.contains("normalTexture") || !height_of(material).is_null();
}

/// One flag per material of the file: some mesh of the scene has it.
std::vector<bool> materials_in_scene(const Document& document, const NodeGraph& graph) {
    std::vector<bool> used(document.model.materials.size(), false);
    for (const std::size_t node : graph.in_scene) {
        if (!has_visible_mesh(document, graph, node)) continue;
        for (const tinygltf::Primitive& primitive :
             document.model.meshes[as_index(document.model.nodes[node].mesh)].primitives)
            if (primitive.material >= 0) used[as_index(primitive.material)] = true;
    }
    return used;
}

/// The first texture that lighting needs and that is not read; empty where there is none.
std::string unread_texture(const Document& document, const std::vector<bool>& used) {
    const json& look = document.look;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const json& material = look["materials"][i];
        const Place place = document.root() / "materials" / i;
        const json& decal = find(material, {"pbrMetallicRoughness", "baseColorTexture", "index"});
        if (is_unread(look, decal))
            return (place / "pbrMetallicRoughness" / "baseColorTexture").pointer();
        if (is_unread(look, find(material, {"normalTexture", "index"})))
            return (place / "normalTexture").pointer();
        if (is_unread(look, find(height_of(material), {"index"})))
            return (place / "extras" / "shadowproof" / "height").pointer();
    }
    return {};
}

/// Numbers of 0 and more, as colours are.
glm::dvec3 read_color(const Place& place, const json& value) {
    glm::dvec3 color(0);
    for (int k = 0; k < 3; ++k) {
        color[k] = value[static_cast<std::size_t>(k)];
        if (color[k] < 0)
            (place / static_cast<std::size_t>(k)).refuse("is negative", "write 0 or more");
    }
    return color;
}

/// One material being read.
struct MaterialSource {
    const json& value;
    Place place;
    TextureReader& textures;
    Material& material;
    CoordinateSets& sets;
    bool has_environment = false; ///< of the file
};

void read_look(const MaterialSource& source) {
    const json& base = find(source.value, {"pbrMetallicRoughness", "baseColorFactor"});
    const Place place = source.place / "pbrMetallicRoughness";
    if (!base.is_null()) source.material.color = read_color(place / "baseColorFactor", base);
    const json& decal = find(source.value, {"pbrMetallicRoughness", "baseColorTexture"});
    if (!decal.is_null()) {
        source.material.decal = source.textures.read(place / "baseColorTexture" / "index",
                                                     decal["index"], Encoding::srgb);
        source.sets.decal = read_coordinates(decal);
    }
    const json& ours = find(source.value, {"extras", "shadowproof"});
    const Place extras = source.place / "extras" / "shadowproof";
    if (const json& specular = find(ours, {"specular"}); !specular.is_null())
        source.material.specular = read_color(extras / "specular", specular);
    if (const json& reflectance = find(ours, {"reflectance"}); !reflectance.is_null()) {
        if (!source.has_environment)
            (extras / "reflectance")
                .refuse("reflects an environment that the file does not have",
                        "give it an extras.shadowproof.environment");
        source.material.reflectance = read_color(extras / "reflectance", reflectance);
    }
    source.material.gloss_in_alpha = find(ours, {"glossInAlpha"}) == true;
    if (source.material.gloss_in_alpha && decal.is_null())
        (extras / "glossInAlpha").refuse("asks for the alpha of no texture", "add a decal");
}

/// Whether heights are in units of space, not in texels.
bool is_in_space(const Place& place, const json& height) {
    const std::string unit = height.value("unit", "texel");
    if (unit != "texel" && unit != "space")
        place.refuse(fmt::format("is \"{}\"", unit),
                     "choose texel, or space for the units of positions");
    return unit == "space";
}

void read_bump_map(const MaterialSource& source) {
    const json& height = height_of(source.value);
    const bool is_height = !height.is_null();
    const json& map = is_height ? height : find(source.value, {"normalTexture"});
    if (map.is_null()) return;
    if (is_height && source.value.contains("normalTexture"))
        (source.place / "extras" / "shadowproof" / "height")
            .refuse("is a second bump map beside the normalTexture", "keep one");
    const Place place = is_height ? source.place / "extras" / "shadowproof" / "height"
                                  : source.place / "normalTexture";
    source.material.bump = is_height ? Bump::height_field : Bump::normal_map;
    source.material.bump_scale = map.value("scale", 1.0);
    if (is_height) source.material.height_in_space = is_in_space(place / "unit", map);
    source.material.bump_map = source.textures.read(place / "index", map["index"], Encoding::plain);
    source.sets.bump = read_coordinates(map);
}

/// What lighting does not evaluate although glTF has it.
void note_unevaluated(const MaterialSource& source, std::vector<std::string>& notes) {
    const char* const lighting = "is not evaluated: lighting is diffuse and specular, without "
                                 "roughness or metal";
    for (const char* key : {"emissiveTexture", "occlusionTexture"})
        if (source.value.contains(key))
            notes.push_back(fmt::format("{} {}", (source.place / key).pointer(), lighting));
    if (!find(source.value, {"pbrMetallicRoughness", "metallicRoughnessTexture"}).is_null())
        notes.push_back(fmt::format("{}/pbrMetallicRoughness/metallicRoughnessTexture {}",
                                    source.place.pointer(), lighting));
}

void read_highlight(const Document& document, const json& look, Highlight& highlight) {
    const json& given = find(look, {"extras", "shadowproof", "highlight"});
    const Place place = document.root() / "extras" / "shadowproof" / "highlight";
    if (const json& name = find(given, {"shadow"}); !name.is_null()) {
        const auto* const found =
            std::ranges::find(all_highlight_shadows, name.get<std::string>(),
                              [](HighlightShadow shadow) { return name_of(shadow); });
        if (found == all_highlight_shadows.end())
            (place / "shadow")
                .refuse(fmt::format("is \"{}\"", name.get<std::string>()),
                        "choose light, half_angle, both or none");
        highlight.shadow = *found;
    }
    if (const json& exponent = find(given, {"exponent"}); !exponent.is_null()) {
        const auto value = exponent.get<unsigned>();
        if (!std::has_single_bit(value))
            (place / "exponent")
                .refuse(fmt::format("is {}, which no squaring makes", value),
                        fmt::format("take a power of two, up to {}", 1U << largest_squarings));
        highlight.squarings = std::countr_zero(value);
    }
}

void read_scene_extras(const Document& document, const json& look, Scene& scene) {
    const Place place = document.root() / "extras" / "shadowproof" / "ambient";
    if (const json& ambient = find(look, {"extras", "shadowproof", "ambient"}); !ambient.is_null())
        scene.ambient = read_color(place, ambient);
    scene.inverse_square = find(look, {"extras", "shadowproof", "inverseSquare"}) == true;
    read_highlight(document, look, scene.highlight);
}

void read_environment(const Document& document, const json& look, TextureReader& textures,
                      Scene& scene) {
    const json& faces = find(look, {"extras", "shadowproof", "environment", "faces"});
    if (faces.is_null()) return;
    const Place place = document.root() / "extras" / "shadowproof" / "environment" / "faces";
    CubeFaces<glm::vec3> environment;
    if (faces.size() != environment.size())
        place.refuse(fmt::format("has {} elements, not {}", faces.size(), environment.size()),
                     "name six textures: +x -x +y -y +z -z");
    for (std::size_t i = 0; i < environment.size(); ++i) {
        const TextureImage face = textures.decode(place / i, faces[i], Encoding::srgb);
        environment[i] = converted<glm::vec3>(face.texels, [](const glm::vec4& t) { return t; });
        const int width = environment[i].width;
        const int height = environment[i].height;
        if (width != height || width != environment[0].width)
            (place / i).refuse(fmt::format("is of {}x{} texels", width, height),
                               "make the six images square, and of one size");
    }
    scene.environment = std::move(environment);
}

void read_plain(const Document& document, Scene& scene) {
    for (const tinygltf::Material& source : document.model.materials) {
        const Place place = document.root() / "materials" / scene.materials.size();
        Material& material = scene.materials.emplace_back();
        material.name = source.name.empty() ? place.pointer() : source.name;
        material.double_sided = source.doubleSided;
    }
    scene.materials.emplace_back().name = "default";
}

} // namespace

Materials read_materials(const Document& document, const NodeGraph& graph, Scene& scene) {
    read_plain(document, scene);
    Materials materials;
    materials.sets.resize(scene.materials.size());
    const std::vector<bool> used = materials_in_scene(document, graph);
    read_masks(document, used, materials, scene);
    for (std::size_t i = 0; i < used.size(); ++i)
        materials.bump_lit =
            materials.bump_lit || (used[i] && has_bump_map(document.look["materials"][i]));
    if (!materials.bump_lit) return materials;
    if (const std::string unread = unread_texture(document, used); !unread.empty()) {
        materials.bump_lit = false;
        scene.notes.push_back(unread +
                              " is in a format that is not read: no surface is lit by bump "
                              "maps, and visibility alone is judged");
        return materials;
    }
    json look = document.look;
    check_lighting(document.root(), look);
    read_scene_extras(document, look, scene);
    TextureReader textures(document, look, scene.textures);
    read_environment(document, look, textures, scene);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const MaterialSource source{
            look["materials"][i], document.root() / "materials" / i, textures, scene.materials[i],
            materials.sets[i],    scene.environment.has_value()};
        read_look(source);
        read_bump_map(source);
        note_unevaluated(source, scene.notes);
    }
    if (textures.asks_for_nearest())
        scene.notes.push_back("samplers that ask for the nearest texel are evaluated as linear");
    return materials;
}

} // namespace shadowproof::gltf
