// Decoder of EXT_meshopt_compression and KHR_meshopt_compression, written from the specifications
// of their bitstreams. The latter adds a second version of the attributes and the filter COLOR;
// both are read under either name.
#pragma once

#include "scenes/load/compressed/byte_reader.h"

#include <cstdint>
#include <span>

namespace shadowproof {

enum class MeshoptMode : std::uint8_t { attributes, triangles, indices };
enum class MeshoptFilter : std::uint8_t { none, octahedral, quaternion, exponential, color };

/// What the extension says of a stream. check_meshopt holds the rules for its members.
struct MeshoptLayout {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none; ///< of attributes only
    std::size_t count = 0;                      ///< elements
    std::size_t stride = 0;                     ///< bytes per element
};

/// Refuses at `place`, the extension's object, what the specification forbids: strides that do not
/// fit the mode or the filter, triangles whose count is no multiple of three.
void check_meshopt(const Place& place, const MeshoptLayout& layout);

/// Decodes into count * stride bytes, after check_meshopt. Throws Error at `place` where the stream
/// is damaged. Time is linear in the stream and the result.
void decode_meshopt(const Place& place, const MeshoptLayout& layout, Bytes stream,
                    std::span<unsigned char> target);

} // namespace shadowproof
