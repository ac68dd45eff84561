#include "scenes/load/compressed/draco.h"

#include "scenes/load/compressed/apart.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace shadowproof {

namespace {

/// Bytes that the decoder takes for each triangle, for each vertex and for each byte of the stream
/// and of the result, at most, and beside them: twice what tests/scenes/load/draco_test.cpp has
/// measured.
constexpr std::uint64_t bytes_of_triangle = 400;
constexpr std::uint64_t bytes_of_vertex = 200;
constexpr std::uint64_t bytes_of_byte = 8;
constexpr std::uint64_t bytes_beside = 32'000'000;

/// What the child tells, at the head of the shared bytes.
struct Told {
    std::uint64_t begun = 0;  ///< meshes that it has begun with
    std::uint64_t part = 0;   ///< of the mesh at fault, or all_parts
    std::uint64_t failed = 0; ///< whether the words below say why
    std::array<char, 232> words{};
};
constexpr std::uint64_t all_parts = ~std::uint64_t{0};

std::size_t size_of_parts(const DracoMesh& mesh) {
    std::size_t size = 0;
    for (const DracoPart& part : mesh.parts) size += part.size();
    return size;
}

std::uint64_t bytes_to_decode(const DracoMesh& mesh) {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    for (const DracoPart& part : mesh.parts) {
        std::uint64_t& count = part.id == DracoPart::indices ? triangles : vertices;
        count = std::max<std::uint64_t>(count, part.count);
    }
    return bytes_beside + bytes_of_triangle * (triangles / 3) + bytes_of_vertex * vertices +
           bytes_of_byte * (mesh.stream.size() + size_of_parts(mesh));
}

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

void tell(Told& told, std::uint64_t part, const std::string& words) {
    told.part = part;
    told.failed = 1;
    const std::size_t length = std::min(words.size(), told.words.size() - 1);
    std::copy_n(words.begin(), length, told.words.begin());
}

/// In the child. False where it has told of a fault.
bool decode(const DracoMesh& mesh, unsigned char* target, Told& told) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(mesh.stream.data()), mesh.stream.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        tell(told, all_parts,
             fmt::format("is refused by Draco: {}", decoded.status().error_msg_string()));
        return false;
    }
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        const std::string fault = write_part(*decoded.value(), mesh.parts[i], target);
        if (!fault.empty()) {
            tell(told, i, fault);
            return false;
        }
        target += mesh.parts[i].size();
    }
    return true;
}

[[noreturn]] void refuse(const DracoMesh& mesh, const Told& told) {
    const Place& place = told.part < mesh.parts.size() ? mesh.parts[told.part].place : mesh.place;
    place.refuse(told.words.data(), "compress the asset again");
}

[[noreturn]] void refuse(const DracoMesh& mesh, ApartEnd end) {
    const std::string again = "compress the asset again, or export it without Draco";
    switch (end) {
    case ApartEnd::no_process:
        mesh.place.refuse("cannot be decoded: no process can be started for it",
                          "see the limits on processes and memory (ulimit -u)");
    case ApartEnd::out_of_memory:
        mesh.place.refuse("takes more memory to decode than its accessors' counts account for",
                          again);
    case ApartEnd::out_of_time:
        mesh.place.refuse("takes longer to decode than its accessors' counts account for", again);
    default:
        mesh.place.refuse("is damaged: Draco's decoder crashed on it", again);
    }
}

/// Checks and moves out what the child has written.
void take_parts(std::vector<DracoMesh>& meshes, std::span<const unsigned char> written,
                MemoryAccount& memory) {
    for (DracoMesh& mesh : meshes)
        for (DracoPart& part : mesh.parts) {
            memory.keep({part.size(), part.place.where(), "its elements", "split the accessor"});
            const auto own = written.first(part.size());
            part.bytes.assign(own.begin(), own.end());
            written = written.subspan(part.size());
        }
}

} // namespace

void decode_draco(std::vector<DracoMesh>& meshes, MemoryAccount& memory) {
    if (meshes.empty()) return;
    std::size_t parts = 0;
    std::uint64_t most = 0;
    std::uint64_t stream = 0;
    for (const DracoMesh& mesh : meshes) {
        parts += size_of_parts(mesh);
        stream += mesh.stream.size();
        most = std::max(most, bytes_to_decode(mesh));
        memory.require({parts + most, mesh.place.where(), "decoding it", "split the asset"});
    }
    const MemoryHold held =
        memory.hold({parts + most, meshes.front().place.where(), "decoding it", "split the asset"});
    const SharedBytes shared(sizeof(Told) + parts);
    auto& told = *new (shared.bytes().data()) Told;
    unsigned char* const target = shared.bytes().data() + sizeof(Told);
    // A slow machine decodes a megabyte in a second: a hundred times slower than this one.
    const std::uint64_t seconds = 10 + (parts + stream) / 1'000'000;
    const ApartEnd end = run_apart({most, seconds}, [&] {
        unsigned char* at = target;
        for (const DracoMesh& mesh : meshes) {
            ++told.begun;
            if (!decode(mesh, at, told)) return;
            at += size_of_parts(mesh);
        }
    });
    const std::size_t last = std::clamp<std::size_t>(told.begun, 1, meshes.size()) - 1;
    told.words.back() = 0;
    if (end != ApartEnd::finished) refuse(meshes[last], end);
    if (told.failed != 0) refuse(meshes[last], told);
    take_parts(meshes, {target, parts}, memory);
}

} // namespace shadowproof
