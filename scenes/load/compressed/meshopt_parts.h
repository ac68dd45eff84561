// The parts of the meshopt decoder, for meshopt.cpp alone.
#pragma once

#include "scenes/load/compressed/meshopt.h"

namespace shadowproof::meshopt {

/// Elements of any layout, byte by byte as differences to the element before (Appendix A, mode 0).
void decode_attributes(const Place& place, const MeshoptLayout& layout, Bytes stream,
                       std::span<unsigned char> target);

/// A list of triangles, coded by edges and vertices seen shortly before (Appendix A, mode 1).
void decode_triangles(const Place& place, const MeshoptLayout& layout, Bytes stream,
                      std::span<unsigned char> target);

/// Any sequence of indices, as differences to one of two earlier ones (Appendix A, mode 2).
void decode_indices(const Place& place, const MeshoptLayout& layout, Bytes stream,
                    std::span<unsigned char> target);

/// Undoes a filter in place (Appendix B). Values that no encoder writes (a vector without length, a
/// colour without alpha bits) become 0.
void undo_filter(const MeshoptLayout& layout, std::span<unsigned char> target);

} // namespace shadowproof::meshopt
