// Meshes that are compressed by Draco (KHR_draco_mesh_compression), decoded by Google's library in
// a process of its own (isolated.h): damaged streams may crash it, or make it allocate without
// bound.
#pragma once

#include "scenes/load/compressed/byte_reader.h"
#include "scenes/memory_budget.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// What one accessor takes from a stream.
struct DracoPart {
    static constexpr std::int64_t indices = -1; ///< three per triangle, rather than an attribute
    std::int64_t id = indices;                  ///< the attribute's unique id in the stream
    std::size_t count = 0;                      ///< elements that the accessor declares
    std::size_t components = 1;                 ///< of each
    int component_type = 0;                     ///< glTF's number: 5120 to 5126
    std::size_t component_bytes = 4;
    Place place;                        ///< of the accessor
    std::vector<unsigned char> bytes{}; ///< set by decode_draco: the elements, without gaps

    std::size_t size() const { return count * components * component_bytes; }
};

/// A compressed mesh, and which parts of it are to be decoded.
struct DracoMesh {
    Bytes stream;
    Place place; ///< of the primitive's extension
    std::vector<DracoPart> parts;
};

/// Decodes all of them, in one process after the other as long as each succeeds. The counts that
/// the accessors declare bound what the decoder may allocate, which is taken from the budget
/// first; a stream that holds more, fewer, or other components is refused. Throws Error.
void decode_draco(std::vector<DracoMesh>& meshes, MemoryAccount& memory);

} // namespace shadowproof
