// What a cell of a picture adds to results.json, checked when it is read back.
#pragma once

#include "compare/json/json_place.h"

namespace shadowproof {

/// Family::check_results of pictures.
void check_picture_results(const JsonPlace& cell);

} // namespace shadowproof
