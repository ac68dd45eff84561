#include "raster/joined.h"

namespace shadowproof {

Technique bump_three_pass_technique();
Technique zpass_technique();

/// Where near plane or eye spoil what zpass counts, the light is added to bumps in shadow, or kept
/// from lit ones.
Technique bump_three_pass_zpass_technique() {
    Technique technique = joined_technique(bump_three_pass_technique(), zpass_technique());
    technique.name = "bump_three_pass+zpass";
    technique.summary = "zpass, and bumps lit in three passes of 8 bits a channel";
    technique.source = "Kilgard 2001, bumps and stencilled shadow volumes together";
    technique.needs = "bump maps, and a near plane outside every shadow volume";
    technique.cost = 4.6;
    return technique;
}

} // namespace shadowproof
