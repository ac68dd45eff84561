// Compressed data of a document: buffer views by EXT_meshopt_compression or
// KHR_meshopt_compression, primitives by KHR_draco_mesh_compression. Before tinygltf reads the JSON
// they are taken out of it and get buffers of their own, which are filled afterwards; to all other
// code the file looks as if it were not compressed.
#pragma once

#include "scenes/load/compressed/meshopt.h"
#include "scenes/load/gltf/file.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace shadowproof::gltf {

/// A buffer view whose bytes are a meshopt stream's.
struct CompressedView {
    Place place; ///< of the extension's object
    MeshoptLayout layout;
    std::size_t source = 0; ///< the buffer with the stream,
    std::size_t offset = 0; ///< where it begins there
    std::size_t length = 0; ///< and its bytes
    std::size_t target = 0; ///< the buffer that it is decoded to
};

/// An accessor whose elements are in a Draco stream.
struct CompressedAccessor {
    std::size_t accessor = 0;
    std::int64_t id = 0;    ///< as DracoPart has it
    std::size_t target = 0; ///< the buffer that it is decoded to
};

/// A buffer view that is a Draco stream.
struct CompressedMesh {
    Place place; ///< of the extension's object that names it first
    std::size_t view = 0;
    std::vector<CompressedAccessor> accessors{};
};

struct Compressed {
    std::vector<CompressedView> views;
    std::vector<CompressedMesh> meshes;
    /// One flag per buffer: it has no bytes of its own, but is filled by `decompress`, or it is the
    /// fallback for readers that do not know the extension.
    std::vector<bool> placeholders;
};

/// After check_json. `has_chunk`: the file is a GLB with a chunk for buffer 0.
Compressed take_compressed(const Place& root, nlohmann::json& document, bool has_chunk);

/// Fills the buffers that take_compressed added. The account must have room for what the file
/// declares before anything is decoded. Throws Error.
void decompress(const Place& root, const Compressed& compressed, tinygltf::Model& model,
                MemoryAccount& memory);

} // namespace shadowproof::gltf
