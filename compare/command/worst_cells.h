// The end of a long run: which of its cells have the most wrong pixels.
#pragma once

#include "compare/report/report.h"

#include <string>
#include <vector>

namespace shadowproof {

/// The lines of at most five cells, worst first: those that fail by the report's gate, then those
/// that differ beyond edges; among these by their number of wrong pixels. Empty for a single
/// scene and for few cells, whose lines are still in sight.
std::vector<std::string> worst_cells(const Report& report);

} // namespace shadowproof
