// What the documents claim of bump mapping.
#pragma once

#include "tests/claims/section.h"

#include <vector>

namespace shadowproof::claims {

std::vector<Section> bump_claims();

} // namespace shadowproof::claims
