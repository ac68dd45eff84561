#include "raster/techniques/bumps/filtered.h"

namespace shadowproof {

/// As bump_mipmapped, with means of slopes and of their products. Those tell variances and
/// covariance of slopes, so that highlights become wider along which way the bumps vary, and darker
/// as they do: the half-angle vector's slope in a Gaussian of these. Of a smooth surface that is a
/// little less than the cosine's power, which falls off slower.
Technique bump_lean_technique() {
    return filtered_technique<BumpFilter::lean>(
        "bump_lean", "bump_mipmapped from mean slopes, highlights as slopes vary",
        "Olano & Baker 2010 (LEAN mapping)", 4.9);
}

} // namespace shadowproof
