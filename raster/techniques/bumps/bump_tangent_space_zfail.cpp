#include "raster/joined.h"

namespace shadowproof {

Technique bump_tangent_space_technique();
Technique zfail_technique();

/// Where the far plane spoils what zfail counts, the light is added to bumps in shadow, or kept
/// from lit ones.
Technique bump_tangent_space_zfail_technique() {
    Technique technique = joined_technique(bump_tangent_space_technique(), zfail_technique());
    technique.name = "bump_tangent_space+zfail";
    technique.summary = "zfail, and bumps lit in tangent space, in floating point";
    technique.source = "Kilgard 2001, bumps and stencilled shadow volumes together";
    technique.needs = "bump maps, closed volumes, and a far plane that cuts none of them";
    technique.cost = 4.1;
    return technique;
}

} // namespace shadowproof
