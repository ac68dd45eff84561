#include "scenes/load/gltf/attribute.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof::gltf {

namespace {

unsigned kinds_of(const Document& document, const Attribute& attribute) {
    const std::vector<std::string>& used = document.model.extensionsUsed;
    const bool quantized =
        std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
    return quantized ? attribute.kinds | attribute.quantized_kinds : attribute.kinds;
}

void require_count(const Place& reference, const Elements& elements, std::size_t vertices,
                   const char* what) {
    if (elements.count != vertices)
        reference.refuse(fmt::format("has {} elements for {} vertices", elements.count, vertices),
                         fmt::format("give each vertex one {}", what));
}

} // namespace

bool has_attribute(const Part& part, const Attribute& attribute) {
    return part.primitive.attributes.count(attribute.name) != 0;
}

Elements read_morphed(AccessorReader& reader, const Part& part, const Attribute& attribute,
                      const std::vector<double>& weights, std::size_t vertices) {
    const unsigned kinds = kinds_of(reader.document(), attribute);
    const Place place = part.place / "attributes" / attribute.name;
    const int accessor = part.primitive.attributes.at(attribute.name);
    Elements values = reader.read(place, accessor, attribute.type, kinds);
    if (vertices != 0) require_count(place, values, vertices, "value");
    const auto& targets = part.primitive.targets;
    if (!weights.empty() && weights.size() != targets.size())
        part.place.refuse(
            fmt::format("has {} morph targets for {} weights", targets.size(), weights.size()),
            "give each target one weight");
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto target = targets[i].find(attribute.name);
        if (target == targets[i].end() || weights[i] == 0) continue;
        const Place reference = part.place / "targets" / i / attribute.name;
        const Elements offsets =
            reader.read(reference, target->second, attribute.displacement_type, kinds);
        require_count(reference, offsets, values.count, "displacement");
        for (std::size_t k = 0; k < values.count; ++k)
            for (std::size_t c = 0; c < offsets.components; ++c)
                values.values[k * values.components + c] +=
                    weights[i] * offsets.values[k * offsets.components + c];
    }
    return values;
}

} // namespace shadowproof::gltf
