// What the documents claim of shadow maps against shadow volumes.
#pragma once

#include "tests/claims/section.h"

#include <vector>

namespace shadowproof::claims {

std::vector<Section> map_claims();

} // namespace shadowproof::claims
