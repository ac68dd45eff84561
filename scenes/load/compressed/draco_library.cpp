// The module that decode_draco loads. It must not need any other part of the house.
#include "scenes/load/compressed/draco_library.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace shadowproof {

namespace {

void write_indices(const draco::Mesh& mesh, const DracoPart& part, unsigned char* target) {
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(face)) {
            const std::uint32_t index = point.value();
            std::memcpy(target, &index, part.component_bytes); // little-endian
            target += part.component_bytes;
        }
}

/// The attribute's value of each vertex as type T. False where the stream's values do not fit.
template <class T>
bool write_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                  const DracoPart& part, unsigned char* target) {
    std::array<T, 16> value{};
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex at = attribute.mapped_index(point);
        if (at.value() >= attribute.size()) return false;
        if (!attribute.ConvertValue<T>(at, static_cast<std::int8_t>(part.components), value.data()))
            return false;
        std::memcpy(target, value.data(), part.components * sizeof(T));
        target += part.components * sizeof(T);
    }
    return true;
}

bool write_attribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                     const DracoPart& part, unsigned char* target) {
    switch (part.component_type) {
    case 5120:
        return write_values<std::int8_t>(mesh, attribute, part, target);
    case 5121:
        return write_values<std::uint8_t>(mesh, attribute, part, target);
    case 5122:
        return write_values<std::int16_t>(mesh, attribute, part, target);
    case 5123:
        return write_values<std::uint16_t>(mesh, attribute, part, target);
    case 5125:
        return write_values<std::uint32_t>(mesh, attribute, part, target);
    default:
        return write_values<float>(mesh, attribute, part, target);
    }
}

/// Why a part cannot be had; empty where it was written.
std::string write_part(const draco::Mesh& mesh, const DracoPart& part, unsigned char* target) {
    if (part.id == DracoPart::indices) {
        const std::size_t count = std::size_t{3} * mesh.num_faces();
        if (count != part.count)
            return fmt::format("has a count of {}, but the compressed mesh has {} indices",
                               part.count, count);
        write_indices(mesh, part, target);
        return {};
    }
    if (mesh.num_points() != part.count)
        return fmt::format("has a count of {}, but the compressed mesh has {} vertices", part.count,
                           mesh.num_points());
    const draco::PointAttribute* const attribute =
        mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(part.id));
    if (attribute == nullptr)
        return fmt::format("is attribute {} of a compressed mesh that has no such one", part.id);
    if (static_cast<std::size_t>(attribute->num_components()) != part.components)
        return fmt::format("has {} components, but the compressed mesh has {}", part.components,
                           attribute->num_components());
    const bool is_whole =
        attribute->buffer() != nullptr &&
        attribute->size() <=
            attribute->buffer()->data_size() /
                static_cast<std::size_t>(std::max<std::int64_t>(attribute->byte_stride(), 1));
    if (!is_whole || !write_attribute(mesh, *attribute, part, target))
        return "holds what its compressed mesh cannot be converted to";
    return {};
}

DracoFault decode(const DracoMesh& mesh, unsigned char* target) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(mesh.stream.data()), mesh.stream.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return {fmt::format("is refused by Draco: {}", decoded.status().error_msg_string())};
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        const std::string fault = write_part(*decoded.value(), mesh.parts[i], target);
        if (!fault.empty()) return {fault, i};
        target += mesh.parts[i].size();
    }
    return {};
}

} // namespace

} // namespace shadowproof

/// See draco_entry.
extern "C" __attribute__((visibility("default"))) const shadowproof::DracoLibrary*
shadowproof_draco_1() {
    static const shadowproof::DracoLibrary functions{shadowproof::decode};
    return &functions;
}
