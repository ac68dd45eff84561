#include "raster/techniques/bumps/filtered.h"

namespace shadowproof {

/// As bump_mipmapped. Alpha holds how long the mean normal is, and dims the diffuse term, as the
/// mean of cosines is less than the cosine with the mean's direction. Where all the bumps under a
/// pixel face the light, that is exact: a mean of L . N is L times the mean of N. Highlights are as
/// bump_mipmapped has them.
Technique bump_mipmapped_dimmed_technique() {
    return filtered_technique<BumpFilter::dimmed>(
        "bump_mipmapped_dimmed",
        "bump_mipmapped, its diffuse light dimmed where bumps are averaged",
        "Kilgard 2001 (dimFactor)", 4.1);
}

} // namespace shadowproof
