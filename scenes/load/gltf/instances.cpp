#include "scenes/load/gltf/instances.h"

#include "scenes/load/gltf/nodes.h"

#include <fmt/format.h>

#include <optional>

namespace shadowproof::gltf {

namespace {

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// The attributes that place instances. Others are an application's own.
struct Placements {
    std::optional<Elements> translation{};
    std::optional<Elements> rotation{};
    std::optional<Elements> scale{};
    std::size_t count = 0;
};

std::optional<Elements> read_attribute(AccessorReader& reader, const Place& attributes,
                                       const tinygltf::Value& object, const char* name, int type,
                                       unsigned kinds) {
    if (!object.Has(name)) return std::nullopt;
    return reader.read(attributes / name, object.Get(name).GetNumberAsInt(), type, kinds);
}

Placements read_placements(AccessorReader& reader, const Place& place,
                           const tinygltf::Value& object) {
    Placements placements;
    const auto& accessors = reader.document().model.accessors;
    for (const std::string& name : object.Keys()) {
        const std::size_t count = accessors[as_index(object.Get(name).GetNumberAsInt())].count;
        if (placements.count != 0 && count != placements.count)
            (place / name)
                .refuse(fmt::format("has {} elements for {} instances", count, placements.count),
                        "give each instance one value");
        placements.count = count;
    }
    if (placements.count == 0) place.refuse("has no attributes", "give it a TRANSLATION");
    placements.translation =
        read_attribute(reader, place, object, "TRANSLATION", TINYGLTF_TYPE_VEC3, floats);
    placements.rotation = read_attribute(reader, place, object, "ROTATION", TINYGLTF_TYPE_VEC4,
                                         floats | normalized_integers);
    placements.scale = read_attribute(reader, place, object, "SCALE", TINYGLTF_TYPE_VEC3, floats);
    return placements;
}

Node instance_of(const Placements& placements, const Place& place, std::size_t instance) {
    Node node{.name = {}, .place = place};
    if (placements.translation) node.translation = placements.translation->vec3(instance);
    if (placements.scale) node.scale = placements.scale->vec3(instance);
    if (placements.rotation) {
        const double* q = placements.rotation->values.data() + 4 * instance;
        node.rotation = unit_rotation(place / "ROTATION", {q, q + 4});
    }
    return node;
}

} // namespace

std::vector<glm::dmat4> read_instances(AccessorReader& reader, std::size_t node) {
    const tinygltf::Node& source = reader.document().model.nodes[node];
    const auto found = source.extensions.find(instancing);
    if (found == source.extensions.end()) return {glm::dmat4(1)};
    const Place place =
        reader.document().root() / "nodes" / node / "extensions" / instancing / "attributes";
    if (source.skin >= 0)
        place.refuse("places instances of a mesh with a skin", "take away one of the two");
    const Placements placements = read_placements(reader, place, found->second.Get("attributes"));
    // Placing one takes as long as reading some fifteen elements.
    reader.charge(place, 15 * placements.count);
    reader.memory().require(
        {placements.count * sizeof(glm::dmat4), place.where(), "its instances", "place fewer"});
    std::vector<glm::dmat4> instances;
    instances.reserve(placements.count);
    for (std::size_t i = 0; i < placements.count; ++i)
        instances.push_back(local_transform(instance_of(placements, place, i)));
    return instances;
}

} // namespace shadowproof::gltf
