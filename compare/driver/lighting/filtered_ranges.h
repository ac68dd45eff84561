// What filtering techniques read of mipmaps at a pixel, as ranges: the level by how far neighbours
// are apart in the texture, and the lookups there (raster/glsl/lighting/mipmap.glsl).
#pragma once

#include "compare/driver/interval.h"
#include "compare/driver/lighting/filtered_tables.h"
#include "compare/driver/lighting/lighting_inputs.h"
#include "compare/driver/lighting/lighting_ranges.h"
#include "compare/driver/quad_steps.h"
#include "scenes/texture.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowproof {

/// A pixel's extent over a texture, one of those that are possible.
struct FootprintRange {
    Interval level{}; ///< not negative
    int probes = 1;   ///< lookups along the pixel's longer side
    PlaceRange along{};
};
/// One for each number of lookups and each side that may be the longer; none where the steps are
/// not finite. `size`: the texture's.
std::vector<FootprintRange> footprint_ranges(const PlaceSteps& steps, const glm::ivec2& size,
                                             int anisotropy);

/// A texture's place at a pixel, what wraps it, and the extent that is taken: by its number among
/// footprint_ranges, modulo how many there are.
struct MipmapPlace {
    const TextureImage& map;
    const PlaceRange& at;
    const PlaceSteps& steps;
    std::size_t footprint = 0;
};
/// Where nothing is known of the level: all that any of them holds.
RangeOf<glm::dvec4> filtered_range(const ExpectedMipmap& mipmap, const MipmapPlace& place,
                                   int anisotropy);

/// What a filter leaves of the bumps at a pixel whose material has them.
FilteredBumps filtered_bumps(const ExpectedPyramid& pyramid, const MipmapPlace& place,
                             const ColorModel& model);

/// As decal_range, of a material that has a decal, from its mipmap.
DecalRange filtered_decal(const ExpectedMipmap& mipmap, const Material& material,
                          const MipmapPlace& place, int anisotropy);

} // namespace shadowproof
