#include "raster/techniques/bumps/filtered.h"

namespace shadowproof {

/// As bump_mipmapped. How short the mean normal is tells how much the normals vary, as in a lobe of
/// Gaussian shape, and makes the highlight's exponent smaller and the highlight darker.
Technique bump_toksvig_technique() {
    return filtered_technique<BumpFilter::toksvig>(
        "bump_toksvig", "bump_mipmapped, highlights wider and darker where bumps are averaged",
        "Toksvig 2005", 4.2);
}

} // namespace shadowproof
