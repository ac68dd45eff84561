// What a cell of shadow volumes adds to results.json, checked when it is read back: the counter's
// figures, those of the volumes, and what was saved.
#pragma once

#include "compare/json/json_place.h"

namespace shadowproof {

/// Family::check_results of shadow volumes.
void check_stencil_results(const JsonPlace& cell);

} // namespace shadowproof
