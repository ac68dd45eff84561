#include "scenes/load/gltf/material.h"

#include "scenes/load/gltf/check.h"
#include "scenes/load/gltf/texture.h"

#include <fmt/format.h>

#include <utility>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

/// The member at a path of objects; null where there is none.
const json& find(const json& value, std::initializer_list<const char*> path) {
    static const json none;
    const json* at = &value;
    for (const char* key : path) {
        if (!at->is_object() || !at->contains(key)) return none;
        at = &(*at)[key];
    }
    return *at;
}

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
        const int mesh = document.model.nodes[node].mesh;
        if (mesh < 0) continue;
        for (const tinygltf::Primitive& primitive :
             document.model.meshes[as_index(mesh)].primitives)
            if (primitive.material >= 0) used[as_index(primitive.material)] = true;
    }
    return used;
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
struct Source {
    const json& value;
    Place place;
    TextureReader& textures;
    Material& material;
    CoordinateSets& sets;
    bool has_environment = false; ///< of the file
};

void read_look(const Source& source) {
    const json& base = find(source.value, {"pbrMetallicRoughness", "baseColorFactor"});
    const Place place = source.place / "pbrMetallicRoughness";
    if (!base.is_null()) source.material.color = read_color(place / "baseColorFactor", base);
    const json& decal = find(source.value, {"pbrMetallicRoughness", "baseColorTexture"});
    if (!decal.is_null()) {
        source.material.decal = source.textures.read(place / "baseColorTexture" / "index",
                                                     decal["index"], Encoding::srgb);
        source.sets.decal = decal.value("texCoord", std::size_t{0});
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

void read_bump_map(const Source& source) {
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
    source.material.bump_map = source.textures.read(place / "index", map["index"], Encoding::plain);
    source.sets.bump = map.value("texCoord", std::size_t{0});
}

/// What lighting does not evaluate although glTF has it.
void note_unevaluated(const Source& source, std::vector<std::string>& notes) {
    const char* const lighting = "is not evaluated: lighting is diffuse and specular, without "
                                 "roughness or metal";
    for (const char* key : {"emissiveTexture", "occlusionTexture"})
        if (source.value.contains(key))
            notes.push_back(fmt::format("{} {}", (source.place / key).pointer(), lighting));
    if (!find(source.value, {"pbrMetallicRoughness", "metallicRoughnessTexture"}).is_null())
        notes.push_back(fmt::format("{}/pbrMetallicRoughness/metallicRoughnessTexture {}",
                                    source.place.pointer(), lighting));
}

void read_scene_extras(const Document& document, const json& look, Scene& scene) {
    const Place place = document.root() / "extras" / "shadowproof" / "ambient";
    if (const json& ambient = find(look, {"extras", "shadowproof", "ambient"}); !ambient.is_null())
        scene.ambient = read_color(place, ambient);
    scene.inverse_square = find(look, {"extras", "shadowproof", "inverseSquare"}) == true;
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
        if (source.alphaMode != "OPAQUE")
            scene.notes.push_back(fmt::format("{} \"{}\": alphaMode {} is drawn as opaque",
                                              place.pointer(), material.name, source.alphaMode));
    }
    scene.materials.emplace_back().name = "default";
}

} // namespace

Materials read_materials(const Document& document, const NodeGraph& graph, Scene& scene) {
    read_plain(document, scene);
    Materials materials;
    materials.sets.resize(scene.materials.size());
    const std::vector<bool> used = materials_in_scene(document, graph);
    for (std::size_t i = 0; i < used.size(); ++i)
        materials.bump_lit =
            materials.bump_lit || (used[i] && has_bump_map(document.look["materials"][i]));
    if (!materials.bump_lit) return materials;
    json look = document.look;
    check_lighting(document.root(), look);
    read_scene_extras(document, look, scene);
    TextureReader textures(document, look, scene.textures);
    read_environment(document, look, textures, scene);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const Source source{
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
