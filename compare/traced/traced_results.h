// What a cell of traced shadows adds to results.json, checked when it is read back.
#pragma once

#include "compare/json/json_place.h"

namespace shadowproof {

/// Family::check_results of traced shadows.
void check_traced_results(const JsonPlace& cell);

} // namespace shadowproof
