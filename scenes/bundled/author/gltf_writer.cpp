#include "scenes/bundled/author/gltf_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <optional>

namespace shadowproof::author {

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int component_unsigned_byte = 5121;
constexpr int component_unsigned_short = 5123;
constexpr int component_float = 5126;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;
constexpr int filter_linear = 9729;

Json array(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}
Json array(const glm::dquat& q) {
    return Json::array({q.x, q.y, q.z, q.w});
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t length = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < length ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= length ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

/// The buffer, and the accessors and views into it, as they grow.
struct Buffer {
    std::vector<std::uint8_t> bytes;
    Json views = Json::array();
    Json accessors = Json::array();

    void append(std::uint32_t word, unsigned size) {
        for (unsigned i = 0; i < size; ++i)
            bytes.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
    }

    /// Index of a new view from `offset` to the end, the buffer then padded to whole words. Key
    /// frames have no target.
    std::size_t close_view(std::size_t offset, std::optional<int> target) {
        Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size() - offset}};
        if (target) view["target"] = *target;
        views.push_back(view);
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        return views.size() - 1;
    }
};

/// Index of the new accessor.
std::size_t add_positions(Buffer& buffer, const std::vector<glm::dvec3>& vertices,
                          std::optional<int> target = target_vertices) {
    const std::size_t offset = buffer.bytes.size();
    glm::vec3 low(vertices.front());
    glm::vec3 high = low;
    for (const glm::dvec3& vertex : vertices) {
        const glm::vec3 rounded(vertex);
        low = glm::min(low, rounded);
        high = glm::max(high, rounded);
        for (int k = 0; k < 3; ++k) buffer.append(std::bit_cast<std::uint32_t>(rounded[k]), 4);
    }
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target)},
                                {"componentType", component_float},
                                {"count", vertices.size()},
                                {"type", "VEC3"},
                                {"min", array(low)},
                                {"max", array(high)}});
    return buffer.accessors.size() - 1;
}

/// Float vectors without bounds: normals, tangents, texture coordinates.
template <class Vector>
std::size_t add_vectors(Buffer& buffer, const std::vector<Vector>& vectors) {
    const std::size_t offset = buffer.bytes.size();
    for (const Vector& vector : vectors)
        for (int k = 0; k < vector.length(); ++k)
            buffer.append(std::bit_cast<std::uint32_t>(static_cast<float>(vector[k])), 4);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target_vertices)},
                                {"componentType", component_float},
                                {"count", vectors.size()},
                                {"type", "VEC" + std::to_string(Vector::length())}});
    return buffer.accessors.size() - 1;
}

/// JOINTS_0, in bytes.
std::size_t add_joints(Buffer& buffer, const std::vector<Influence>& influences) {
    const std::size_t offset = buffer.bytes.size();
    for (const Influence& influence : influences)
        for (int k = 0; k < 4; ++k) buffer.append(influence.joints[k], 1);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target_vertices)},
                                {"componentType", component_unsigned_byte},
                                {"count", influences.size()},
                                {"type", "VEC4"}});
    return buffer.accessors.size() - 1;
}

std::size_t add_weights(Buffer& buffer, const std::vector<Influence>& influences) {
    std::vector<glm::dvec4> weights;
    weights.reserve(influences.size());
    for (const Influence& influence : influences) weights.push_back(influence.weights);
    return add_vectors(buffer, weights);
}

Json attributes_of(Buffer& buffer, const Placed& thing) {
    const Shape& shape = thing.shape;
    Json attributes{{"POSITION", add_positions(buffer, shape.vertices)}};
    if (!shape.normals.empty()) attributes["NORMAL"] = add_vectors(buffer, shape.normals);
    if (!shape.tangents.empty()) attributes["TANGENT"] = add_vectors(buffer, shape.tangents);
    if (!shape.coordinates.empty())
        attributes["TEXCOORD_0"] = add_vectors(buffer, shape.coordinates);
    if (!thing.influences.empty()) {
        attributes["JOINTS_0"] = add_joints(buffer, thing.influences);
        attributes["WEIGHTS_0"] = add_weights(buffer, thing.influences);
    }
    return attributes;
}

Json targets_of(Buffer& buffer, const std::vector<Morph>& morphs) {
    Json targets = Json::array();
    for (const Morph& morph : morphs) {
        Json target{{"POSITION", add_positions(buffer, morph.vertices)}};
        if (!morph.normals.empty()) target["NORMAL"] = add_vectors(buffer, morph.normals);
        if (!morph.tangents.empty()) target["TANGENT"] = add_vectors(buffer, morph.tangents);
        targets.push_back(target);
    }
    return targets;
}

std::size_t add_indices(Buffer& buffer, const std::vector<glm::uvec3>& triangles) {
    const std::size_t offset = buffer.bytes.size();
    for (const glm::uvec3& triangle : triangles)
        for (int k = 0; k < 3; ++k) buffer.append(triangle[k], 2);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target_indices)},
                                {"componentType", component_unsigned_short},
                                {"count", 3 * triangles.size()},
                                {"type", "SCALAR"}});
    return buffer.accessors.size() - 1;
}

/// Seconds, of the key frames of an animation.
std::size_t add_times(Buffer& buffer, const std::vector<float>& times) {
    const std::size_t offset = buffer.bytes.size();
    for (const float time : times) buffer.append(std::bit_cast<std::uint32_t>(time), 4);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, std::nullopt)},
                                {"componentType", component_float},
                                {"count", times.size()},
                                {"type", "SCALAR"},
                                {"min", Json::array({times.front()})},
                                {"max", Json::array({times.back()})}});
    return buffer.accessors.size() - 1;
}

void wear(Json& material, const Look& look) {
    if (look.decal) material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", *look.decal}};
    Json ours = Json::object();
    if (look.bump) {
        Json map{{"index", *look.bump}};
        if (look.bump_scale != 1) map["scale"] = look.bump_scale;
        (look.bump_is_height ? ours["height"] : material["normalTexture"]) = map;
    }
    if (look.gloss_in_alpha) ours["glossInAlpha"] = true;
    if (look.specular) ours["specular"] = array(*look.specular);
    if (look.reflectance) ours["reflectance"] = array(*look.reflectance);
    if (!ours.empty()) material["extras"] = {{"shadowproof", ours}};
}

Json material_of(const Placed& thing) {
    Json color = array(thing.color);
    color.push_back(1);
    Json material{{"name", thing.name},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
    if (thing.double_sided) material["doubleSided"] = true;
    wear(material, thing.look);
    return material;
}

Json node_of(const Placed& thing, std::size_t mesh) {
    if (!thing.influences.empty()) return {{"name", thing.name}, {"mesh", mesh}, {"skin", 0}};
    return {{"name", thing.name},
            {"mesh", mesh},
            {"translation", array(thing.position)},
            {"rotation", array(glm::angleAxis(thing.turn, glm::normalize(thing.turn_axis)))}};
}

Json mesh_of(Buffer& buffer, const Placed& thing, std::size_t material) {
    const Json attributes = attributes_of(buffer, thing);
    const std::size_t indices = add_indices(buffer, thing.shape.triangles);
    Json primitive{{"attributes", attributes}, {"indices", indices}, {"material", material}};
    Json mesh{{"name", thing.name}};
    if (!thing.morphs.empty()) {
        primitive["targets"] = targets_of(buffer, thing.morphs);
        mesh["weights"] = std::vector<double>(thing.morphs.size(), 0);
    }
    mesh["primitives"] = Json::array({primitive});
    return mesh;
}

/// The nodes of the joints, which must follow those of all things.
Json joint_nodes(const Stage& stage) {
    const std::size_t first = stage.things.size();
    Json nodes = Json::array();
    for (std::size_t i = 0; i < stage.joints.size(); ++i) {
        const Joint& joint = stage.joints[i];
        Json node{{"name", joint.name}, {"translation", array(joint.position)}};
        if (joint.turn != 0)
            node["rotation"] = array(glm::angleAxis(joint.turn, glm::dvec3(0, 1, 0)));
        for (std::size_t k = 0; k < stage.joints.size(); ++k)
            if (stage.joints[k].parent == i) node["children"].push_back(first + k);
        for (std::size_t k = 0; k < stage.things.size(); ++k)
            if (stage.things[k].joint == i) node["children"].push_back(k);
        nodes.push_back(node);
    }
    return nodes;
}

/// Where a joint is in the root joint's space, in which shapes are modelled.
glm::dvec3 place_in_model(const Stage& stage, std::size_t joint) {
    glm::dvec3 place(0);
    while (stage.joints[joint].parent) {
        place += stage.joints[joint].position;
        joint = *stage.joints[joint].parent;
    }
    return place;
}

/// The one skin, of all joints.
Json skins_of(Buffer& buffer, const Stage& stage) {
    const std::size_t offset = buffer.bytes.size();
    Json joints = Json::array();
    for (std::size_t i = 0; i < stage.joints.size(); ++i) {
        const glm::dvec3 place = place_in_model(stage, i);
        const glm::dmat4 inverse_bind(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -place.x, -place.y,
                                      -place.z, 1);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                buffer.append(
                    std::bit_cast<std::uint32_t>(static_cast<float>(inverse_bind[column][row])), 4);
        joints.push_back(stage.things.size() + i);
    }
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, std::nullopt)},
                                {"componentType", component_float},
                                {"count", stage.joints.size()},
                                {"type", "MAT4"}});
    return {{{"inverseBindMatrices", buffer.accessors.size() - 1}, {"joints", joints}}};
}

/// The rotation of a node that looks or shines down its own -z, y up.
glm::dquat looking(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 back = glm::normalize(from - to);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    return glm::normalize(glm::dquat(glm::dmat3(right, glm::cross(back, right), back)));
}

Json camera_node(const Stage& stage) {
    return {{"name", "camera"},
            {"camera", 0},
            {"translation", array(stage.eye)},
            {"rotation", array(looking(stage.eye, stage.target))}};
}

std::vector<Lamp> lamps_of(const Stage& stage) {
    std::vector<Lamp> lamps{stage.light};
    lamps.insert(lamps.end(), stage.more_lights.begin(), stage.more_lights.end());
    return lamps;
}

Json light_node(const Lamp& lamp, std::size_t index) {
    Json node{{"name", lamp.name}, {"translation", array(lamp.position)}};
    if (lamp.type != "point") node["rotation"] = array(looking(lamp.position, lamp.target));
    node["extensions"] = {{"KHR_lights_punctual", {{"light", index}}}};
    return node;
}

/// The lamp's path as the only animation of the file.
Json animations_of(Buffer& buffer, const Lamp& lamp, std::size_t node) {
    constexpr float seconds = 4;
    const std::size_t times = add_times(buffer, {0, seconds});
    const std::size_t places = add_positions(buffer, {lamp.position, *lamp.moves_to}, std::nullopt);
    return {
        {{"name", "way of the light"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"interpolation", "LINEAR"}, {"output", places}}}}}};
}

/// Index of the new accessor.
std::size_t add_key_values(Buffer& buffer, const Track& track) {
    const std::size_t offset = buffer.bytes.size();
    for (const double value : track.values)
        buffer.append(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    const std::size_t width =
        track.path == "weights" ? 1 : track.values.size() / track.times.size();
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, std::nullopt)},
                                {"componentType", component_float},
                                {"count", track.values.size() / width},
                                {"type", width == 1 ? "SCALAR" : "VEC" + std::to_string(width)}});
    return buffer.accessors.size() - 1;
}

/// All tracks as the only animation of the file.
Json animations_of(Buffer& buffer, const std::vector<Track>& tracks, const Json& nodes) {
    Json channels = Json::array();
    Json samplers = Json::array();
    for (const Track& track : tracks) {
        const auto node = std::find_if(nodes.begin(), nodes.end(), [&](const Json& each) {
            return each["name"] == track.node;
        });
        channels.push_back({{"sampler", samplers.size()},
                            {"target", {{"node", node - nodes.begin()}, {"path", track.path}}}});
        const std::size_t times = add_times(buffer, track.times);
        samplers.push_back({{"input", times},
                            {"interpolation", "LINEAR"},
                            {"output", add_key_values(buffer, track)}});
    }
    return {{{"name", "motion"}, {"channels", channels}, {"samplers", samplers}}};
}

Json cameras_of(const Stage& stage) {
    return {
        {{"name", "camera"},
         {"type", "perspective"},
         {"perspective", {{"yfov", stage.yfov}, {"znear", stage.znear}, {"zfar", stage.zfar}}}}};
}

Json lights_of(const Stage& stage) {
    Json lights = Json::array();
    for (const Lamp& lamp : lamps_of(stage)) {
        Json light{{"name", lamp.name}, {"type", lamp.type}, {"intensity", lamp.intensity}};
        if (lamp.color != glm::dvec3(1)) light["color"] = array(lamp.color);
        if (lamp.type == "spot")
            light["spot"] = {{"innerConeAngle", 0.8 * lamp.outer_cone},
                             {"outerConeAngle", lamp.outer_cone}};
        lights.push_back(light);
    }
    return {{"KHR_lights_punctual", {{"lights", lights}}}};
}

/// Images in the buffer, one texture and one sampler each.
void add_textures(Buffer& buffer, const Stage& stage, Json& gltf) {
    if (stage.textures.empty()) return;
    for (const Painting& painting : stage.textures) {
        const std::size_t offset = buffer.bytes.size();
        buffer.bytes.insert(buffer.bytes.end(), painting.png.begin(), painting.png.end());
        const std::size_t view = buffer.close_view(offset, std::nullopt);
        const std::size_t number = gltf["textures"].size();
        gltf["textures"].push_back({{"sampler", number}, {"source", number}});
        gltf["samplers"].push_back({{"magFilter", filter_linear},
                                    {"minFilter", filter_linear},
                                    {"wrapS", painting.wrap},
                                    {"wrapT", painting.wrap}});
        gltf["images"].push_back(
            {{"name", painting.name}, {"mimeType", "image/png"}, {"bufferView", view}});
    }
    gltf["extras"]["shadowproof"]["ambient"] = array(stage.ambient);
    if (stage.inverse_square) gltf["extras"]["shadowproof"]["inverseSquare"] = true;
    if (!stage.environment.empty())
        gltf["extras"]["shadowproof"]["environment"]["faces"] = stage.environment;
}

/// Indices of the nodes that are no other's children.
Json roots_of(const Json& nodes) {
    std::vector<bool> is_child(nodes.size());
    for (const Json& node : nodes)
        for (const Json& child : node.value("children", Json::array()))
            is_child[child.get<std::size_t>()] = true;
    Json roots = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    return roots;
}

} // namespace

std::string write_gltf(const Stage& stage) {
    Buffer buffer;
    Json nodes = Json::array();
    Json meshes = Json::array();
    Json materials = Json::array();
    for (const Placed& thing : stage.things) {
        nodes.push_back(node_of(thing, meshes.size()));
        meshes.push_back(mesh_of(buffer, thing, materials.size()));
        materials.push_back(material_of(thing));
    }
    for (const Json& node : joint_nodes(stage)) nodes.push_back(node);
    nodes.push_back(camera_node(stage));
    const std::size_t first_light = nodes.size();
    const std::vector<Lamp> lamps = lamps_of(stage);
    for (std::size_t i = 0; i < lamps.size(); ++i) nodes.push_back(light_node(lamps[i], i));
    const Json roots = roots_of(nodes);

    Json gltf;
    gltf["asset"] = {{"version", "2.0"},
                     {"generator", "shadowproof_author"},
                     {"extras", {{"title", stage.title}}}};
    gltf["extras"] = {{"shadowproof", {{"provokes", stage.provokes}}}};
    if (!stage.may_provoke.empty())
        gltf["extras"]["shadowproof"]["provokesWide"] = stage.may_provoke;
    gltf["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf["extensions"] = lights_of(stage);
    gltf["scene"] = 0;
    gltf["scenes"] = {{{"name", stage.name}, {"nodes", roots}}};
    gltf["nodes"] = nodes;
    gltf["cameras"] = cameras_of(stage);
    gltf["meshes"] = meshes;
    gltf["materials"] = materials;
    add_textures(buffer, stage, gltf);
    if (!stage.joints.empty()) gltf["skins"] = skins_of(buffer, stage);
    if (stage.light.moves_to) gltf["animations"] = animations_of(buffer, stage.light, first_light);
    if (!stage.tracks.empty()) gltf["animations"] = animations_of(buffer, stage.tracks, nodes);
    gltf["accessors"] = buffer.accessors;
    gltf["bufferViews"] = buffer.views;
    gltf["buffers"] = {{{"byteLength", buffer.bytes.size()},
                        {"uri", "data:application/octet-stream;base64," + base64(buffer.bytes)}}};
    return gltf.dump(1) + '\n';
}

} // namespace shadowproof::author
