// What it would save to draw shadow volumes only where a light reaches, measured.
#pragma once

#include "tests/claims/section.h"

#include <vector>

namespace shadowproof::claims {

std::vector<Section> reach_claims();

} // namespace shadowproof::claims
