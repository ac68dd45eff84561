#include "tests/scenes/draco_encoder.h"

#include <draco/compression/encode.h>

#include <stdexcept>

namespace shadowproof::test {

std::vector<std::uint8_t> draco_of(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles, bool edgebreaker,
                                   int position_bits) {
    draco::Mesh mesh;
    const auto count = static_cast<std::uint32_t>(positions.size());
    mesh.set_num_points(count);
    draco::GeometryAttribute attribute;
    attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
    const int id = mesh.AddAttribute(attribute, true, count);
    for (std::uint32_t i = 0; i < count; ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &positions[i].x);
    for (const glm::uvec3& t : triangles)
        mesh.AddFace({draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
    draco::Encoder encoder;
    encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                          : draco::MESH_SEQUENTIAL_ENCODING);
    if (position_bits > 0)
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok())
        throw std::runtime_error("Draco does not encode");
    return {buffer.data(), buffer.data() + buffer.size()};
}

} // namespace shadowproof::test
