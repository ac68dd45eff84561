#include "scenes/gltf_skin.h"

#include <fmt/format.h>

namespace shadowproof::gltf {

Skin read_skin(AccessorReader& reader, const NodeGraph& graph, const Item& skin) {
    const Item root = reader.document().root();
    const Item joints = skin.at("joints");
    std::optional<Elements> inverse_bind;
    if (const auto reference = skin.find("inverseBindMatrices")) {
        inverse_bind = reader.read(*reference, {"MAT4"}, floats);
        if (inverse_bind->count < joints.size())
            reference->refuse(
                fmt::format("has {} matrices for {} joints", inverse_bind->count, joints.size()),
                "give each joint one");
    }
    Skin result;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        glm::dmat4 joint_from_mesh(1.0);
        for (std::size_t k = 0; inverse_bind && k < 16; ++k)
            joint_from_mesh[static_cast<int>(k / 4)][static_cast<int>(k % 4)] =
                inverse_bind->values[i * 16 + k];
        const std::size_t node = reference_index(root, "nodes", joints[i]);
        result.world_from_mesh.push_back(graph.nodes[node].world_from_node * joint_from_mesh);
    }
    return result;
}

Influences read_influences(AccessorReader& reader, const Item& primitive, const Skin& skin,
                           std::size_t vertices) {
    Influences influences{{}, {}, primitive};
    const Item attributes = primitive.at("attributes");
    for (std::size_t set = 0;; ++set) {
        const std::string joints_key = fmt::format("JOINTS_{}", set);
        const std::string weights_key = fmt::format("WEIGHTS_{}", set);
        if (set > 0 && !attributes.has(joints_key.c_str())) return influences;
        const Item joints = attributes.at(joints_key.c_str());
        const Item weights = attributes.at(weights_key.c_str());
        influences.joints.push_back(reader.read(joints, {"VEC4"}, unsigned_integers));
        influences.weights.push_back(reader.read(weights, {"VEC4"}, floats | normalized_integers));
        const Elements& indices = influences.joints.back();
        const Elements& shares = influences.weights.back();
        if (indices.count != vertices || shares.count != vertices)
            joints.refuse(fmt::format("has {} elements and {} weights for {} vertices",
                                      indices.count, shares.count, vertices),
                          "give each vertex one of each");
        for (std::size_t k = 0; k < indices.values.size(); ++k) {
            if (indices.values[k] >= static_cast<double>(skin.world_from_mesh.size()))
                joints.refuse(fmt::format("element {} names joint {} of {}", k / 4,
                                          indices.values[k], skin.world_from_mesh.size()),
                              "mend the joints");
            if (shares.values[k] < 0)
                weights.refuse(fmt::format("element {} is negative", k / 4), "mend the weights");
        }
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

} // namespace shadowproof::gltf
