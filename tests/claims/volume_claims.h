// What the documents claim of stencilled shadow volumes, measured.
#pragma once

#include "tests/claims/section.h"

#include <vector>

namespace shadowproof::claims {

std::vector<Section> volume_claims();

} // namespace shadowproof::claims
