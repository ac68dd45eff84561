// The drawing of one pixel's ledger, made by the same script that draws it in the report.
#pragma once

#include <string>

namespace shadowproof {

/// SVG of technique `technique` (an index) of a pixel record in JSON (schema shadowproof/pixel/1).
/// Throws Error where the script fails, which is a mistake in the program.
std::string draw_cutaway(const std::string& record, std::size_t technique);

} // namespace shadowproof
