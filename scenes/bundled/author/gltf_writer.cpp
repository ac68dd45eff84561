#include "scenes/bundled/author/gltf_writer.h"

#include "scenes/bundled/author/gltf_buffer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace shadowproof::author {

namespace {

// glTF 2.0's numbers.
constexpr int filter_linear = 9729;
constexpr int filter_linear_mipmap_linear = 9987;

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

void set_look(Json& material, const Look& look) {
    if (look.decal) material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", *look.decal}};
    if (look.cutoff) {
        material["alphaMode"] = "MASK";
        material["alphaCutoff"] = *look.cutoff;
    }
    Json ours = Json::object();
    if (look.bump) {
        Json map{{"index", *look.bump}};
        if (look.bump_scale != 1) map["scale"] = look.bump_scale;
        if (look.height_in_space) map["unit"] = "space";
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
    set_look(material, thing.look);
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
        if (lamp.range) light["range"] = *lamp.range;
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
        gltf["samplers"].push_back(
            {{"magFilter", filter_linear},
             {"minFilter", painting.mipmaps ? filter_linear_mipmap_linear : filter_linear},
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
