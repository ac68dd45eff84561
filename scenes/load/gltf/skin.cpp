#include "scenes/load/gltf/skin.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>
#include <optional>

namespace shadowproof::gltf {

Skin read_skin(AccessorReader& reader, const NodeGraph& graph, std::size_t skin) {
    const tinygltf::Skin& source = reader.document().model.skins[skin];
    const Place whole = reader.document().root() / "skins" / skin;
    reader.charge(whole / "joints", source.joints.size());
    std::optional<Elements> inverse_bind;
    if (source.inverseBindMatrices >= 0) {
        const Place place = whole / "inverseBindMatrices";
        inverse_bind = reader.read(place, source.inverseBindMatrices, TINYGLTF_TYPE_MAT4, floats);
        if (inverse_bind->count < source.joints.size())
            place.refuse(fmt::format("has {} matrices for {} joints", inverse_bind->count,
                                     source.joints.size()),
                         "give each joint one");
    }
    Skin result;
    result.held = reader.memory().hold(
        {source.joints.size() * sizeof(glm::dmat4), whole.where(), "its joints", "merge joints"});
    result.world_from_mesh.reserve(source.joints.size());
    for (std::size_t i = 0; i < source.joints.size(); ++i) {
        glm::dmat4 joint_from_mesh(1.0);
        if (inverse_bind) joint_from_mesh = glm::make_mat4(inverse_bind->values.data() + i * 16);
        const Node& joint = graph.nodes[as_index(source.joints[i])];
        result.world_from_mesh.push_back(joint.world_from_node * joint_from_mesh);
    }
    return result;
}

namespace {

/// The accessor of an attribute that a skinned primitive must have.
int required_attribute(const Place& attributes, const tinygltf::Primitive& primitive,
                       const std::string& name) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end())
        attributes.refuse(fmt::format("\"{}\" is missing", name),
                          "add it, for the mesh has a skin");
    return attribute->second;
}

/// The last set of the influences.
void check_set(const Place& joints_place, const Place& weights_place, const Influences& influences,
               const Skin& skin, std::size_t vertices) {
    const Elements& joints = influences.joints.back();
    const Elements& weights = influences.weights.back();
    if (joints.count != vertices || weights.count != vertices)
        joints_place.refuse(fmt::format("has {} elements and {} weights for {} vertices",
                                        joints.count, weights.count, vertices),
                            "give each vertex one of each");
    for (std::size_t k = 0; k < joints.values.size(); ++k) {
        if (joints.values[k] >= static_cast<double>(skin.world_from_mesh.size()))
            joints_place.refuse(fmt::format("element {} names joint {} of {}", k / 4,
                                            joints.values[k], skin.world_from_mesh.size()),
                                "mend the joints");
        if (weights.values[k] < 0)
            weights_place.refuse(fmt::format("element {} is negative", k / 4), "mend the weights");
    }
}

} // namespace

Influences read_influences(AccessorReader& reader, const Place& place,
                           const tinygltf::Primitive& primitive, const Skin& skin,
                           std::size_t vertices) {
    Influences influences{{}, {}, place};
    const Place attributes = place / "attributes";
    for (std::size_t set = 0;; ++set) {
        const std::string joints_name = fmt::format("JOINTS_{}", set);
        const std::string weights_name = fmt::format("WEIGHTS_{}", set);
        if (set > 0 && primitive.attributes.count(joints_name) == 0) return influences;
        const int joints = required_attribute(attributes, primitive, joints_name);
        const int weights = required_attribute(attributes, primitive, weights_name);
        influences.joints.push_back(
            reader.read(attributes / joints_name, joints, TINYGLTF_TYPE_VEC4, unsigned_integers));
        influences.weights.push_back(reader.read(attributes / weights_name, weights,
                                                 TINYGLTF_TYPE_VEC4, floats | normalized_integers));
        check_set(attributes / joints_name, attributes / weights_name, influences, skin, vertices);
    }
}

glm::dvec3 deform(const Skin& skin, const Influences& influences, std::size_t vertex,
                  const glm::dvec4& point) {
    glm::dvec3 moved(0);
    double sum = 0;
    for (std::size_t set = 0; set < influences.joints.size(); ++set)
        for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
            const double weight = influences.weights[set].values[k];
            if (weight == 0) continue;
            const auto joint = static_cast<std::size_t>(influences.joints[set].values[k]);
            moved += weight * glm::dvec3(skin.world_from_mesh[joint] * point);
            sum += weight;
        }
    if (!(sum > 0))
        influences.primitive.refuse(fmt::format("vertex {} has no weight on any joint", vertex),
                                    "weight it");
    return moved / sum;
}

glm::dmat3 deformation(const Skin& skin, const Influences& influences, std::size_t vertex) {
    glm::dmat3 world_from_mesh(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec4 direction(0);
        direction[axis] = 1;
        world_from_mesh[axis] = deform(skin, influences, vertex, direction);
    }
    return world_from_mesh;
}

} // namespace shadowproof::gltf
