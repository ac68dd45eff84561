#include "scenes/load/compressed/meshopt.h"

#include "scenes/load/compressed/meshopt_parts.h"

#include <fmt/format.h>

namespace shadowproof {

namespace {

bool stride_fits_mode(const MeshoptLayout& layout) {
    if (layout.mode != MeshoptMode::attributes) return layout.stride == 2 || layout.stride == 4;
    return layout.stride % 4 == 0 && layout.stride >= 4 && layout.stride <= 256;
}

bool stride_fits_filter(const MeshoptLayout& layout) {
    switch (layout.filter) {
    case MeshoptFilter::octahedral:
    case MeshoptFilter::color:
        return layout.stride == 4 || layout.stride == 8;
    case MeshoptFilter::quaternion:
        return layout.stride == 8;
    case MeshoptFilter::none:
    case MeshoptFilter::exponential:
        break;
    }
    return true;
}

} // namespace

void check_meshopt(const Place& place, const MeshoptLayout& layout) {
    if (!stride_fits_mode(layout))
        (place / "byteStride")
            .refuse(fmt::format("{} does not fit the mode", layout.stride),
                    "use 2 or 4 for indices, a multiple of 4 up to 256 for attributes");
    if (layout.mode != MeshoptMode::attributes && layout.filter != MeshoptFilter::none)
        (place / "filter").refuse("filters indices", "leave it out");
    if (!stride_fits_filter(layout))
        (place / "byteStride")
            .refuse(fmt::format("{} does not fit the filter", layout.stride),
                    "use 8, or 4 for OCTAHEDRAL and COLOR");
    if (layout.mode == MeshoptMode::triangles && layout.count % 3 != 0)
        (place / "count")
            .refuse(fmt::format("{} is no multiple of three", layout.count),
                    "use the mode INDICES for what is no list of triangles");
}

void decode_meshopt(const Place& place, const MeshoptLayout& layout, Bytes stream,
                    std::span<unsigned char> target) {
    switch (layout.mode) {
    case MeshoptMode::attributes:
        meshopt::decode_attributes(place, layout, stream, target);
        return meshopt::undo_filter(layout, target);
    case MeshoptMode::triangles:
        return meshopt::decode_triangles(place, layout, stream, target);
    case MeshoptMode::indices:
        return meshopt::decode_indices(place, layout, stream, target);
    }
}

} // namespace shadowproof
