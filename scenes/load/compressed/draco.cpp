#include "scenes/load/compressed/draco.h"

#include "scenes/load/common/module.h"
#include "scenes/load/compressed/draco_library.h"
#include "scenes/load/compressed/isolated.h"

#include <algorithm>
#include <array>
#include <new>

#ifndef SHADOWPROOF_BUILT_DRACO
#error "SHADOWPROOF_BUILT_DRACO and SHADOWPROOF_INSTALLED_DRACO are set by CMakeLists.txt"
#endif

namespace shadowproof {

namespace {

/// Bytes that the decoder takes for each triangle, for each vertex and for each byte of the stream
/// and of the result, at most, and beside them. Twice what was measured: 48 MB for 318,000
/// triangles of 160,000 vertices with normals and texture coordinates, 106 MB where 499,000
/// vertices share them, at the encoder's slowest speed.
constexpr std::uint64_t bytes_of_triangle = 150;
constexpr std::uint64_t bytes_of_vertex = 150;
constexpr std::uint64_t bytes_of_byte = 5;
constexpr std::uint64_t bytes_beside = 32'000'000;

/// What the child reports, at the head of the shared bytes.
struct Told {
    std::uint64_t begun = 0;  ///< meshes that it has begun with
    std::uint64_t part = 0;   ///< of the mesh at fault, or all of it
    std::uint64_t failed = 0; ///< whether the words below say why
    std::array<char, 232> words{};
};

const DracoLibrary& library() {
    using Entry = const DracoLibrary* (*)();
    static const DracoLibrary& loaded = *reinterpret_cast<Entry>(module_symbol(
        "Draco", {SHADOWPROOF_INSTALLED_DRACO, SHADOWPROOF_BUILT_DRACO}, draco_entry))();
    return loaded;
}

void tell(Told& told, const DracoFault& fault) {
    told.part = fault.part;
    told.failed = 1;
    const std::size_t length = std::min(fault.words.size(), told.words.size() - 1);
    std::copy_n(fault.words.begin(), length, told.words.begin());
}

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

[[noreturn]] void refuse(const DracoMesh& mesh, const Told& told) {
    const Place& place = told.part < mesh.parts.size() ? mesh.parts[told.part].place : mesh.place;
    place.refuse(told.words.data(), "compress the asset again");
}

[[noreturn]] void refuse(const DracoMesh& mesh, IsolatedEnd end) {
    const std::string again = "compress the asset again, or export it without Draco";
    switch (end) {
    case IsolatedEnd::no_process:
        mesh.place.refuse("cannot be decoded: no process can be started for it",
                          "see the limits on processes and memory (ulimit -u)");
    case IsolatedEnd::out_of_memory:
        mesh.place.refuse("takes more memory to decode than its accessors' counts account for",
                          again);
    case IsolatedEnd::out_of_time:
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
    const DracoLibrary& decoder = library(); // not in the child, whose memory is limited
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
    // Measured: 40 MB a second, at the encoder's slowest speed. This allows for a fortieth of it.
    const std::uint64_t seconds = 10 + (parts + stream) / 1'000'000;
    const IsolatedEnd end = run_isolated({most, seconds}, [&] {
        unsigned char* at = target;
        for (const DracoMesh& mesh : meshes) {
            ++told.begun;
            const DracoFault fault = decoder.decode(mesh, at);
            if (!fault.words.empty()) return tell(told, fault);
            at += size_of_parts(mesh);
        }
    });
    const std::size_t last = std::clamp<std::size_t>(told.begun, 1, meshes.size()) - 1;
    told.words.back() = 0;
    if (end != IsolatedEnd::finished) refuse(meshes[last], end);
    if (told.failed != 0) refuse(meshes[last], told);
    take_parts(meshes, {target, parts}, memory);
}

} // namespace shadowproof
