// What a cell of shadow maps adds to results.json, checked when it is read back.
#pragma once

#include "compare/json/json_place.h"

namespace shadowproof {

/// Family::check_results of shadow maps.
void check_map_results(const JsonPlace& cell);

} // namespace shadowproof
