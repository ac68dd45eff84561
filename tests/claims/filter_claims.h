// What the documents claim of filtering bump maps.
#pragma once

#include "tests/claims/section.h"

#include <vector>

namespace shadowproof::claims {

std::vector<Section> filter_claims();

} // namespace shadowproof::claims
