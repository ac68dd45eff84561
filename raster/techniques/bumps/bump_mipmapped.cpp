#include "raster/techniques/bumps/filtered.h"

namespace shadowproof {

/// As bump_tangent_space, with normals and decals from mipmaps: trilinear lookups, at the level of
/// which a texel is as large as the pixel. The mean normal is normalised again. That is the normal
/// of a smooth surface: nothing is left of the bumps below a pixel, whose highlights point
/// elsewhere. Averaging normals is not averaging reflections.
Technique bump_mipmapped_technique() {
    return filtered_technique<BumpFilter::renormalised>(
        "bump_mipmapped", "bump_tangent_space from mean normals, normalised again",
        "Williams 1983; CS448 lecture 11, filtering", 4.3);
}

} // namespace shadowproof
