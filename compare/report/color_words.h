// One pixel's colour in words, and as JSON of schema shadowproof/pixel/1.
#pragma once

#include "compare/color/color_check.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace shadowproof {

/// Several lines, each indented; one where it is that of what is shown.
std::string to_text(const ColorAccount& account, const std::string& technique);

nlohmann::ordered_json to_json(const ColorAccount& account);

std::string_view name_of(ColorVerdict verdict); ///< "within"

} // namespace shadowproof
