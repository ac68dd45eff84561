// Whether bundled scenes stopped provoking their causes, where several runs have parts of them.
#pragma once

#include "compare/results/merge.h"

#include <vector>

namespace shadowproof {

/// Decides it again for scenes of which several runs have cells, or lights: a cause is shown if any
/// cell under any of the lights shows it. `arguments`: the runs' settings.
void settle_what_is_provoked(std::vector<MergedScene>& scenes, const ResultsJson& arguments,
                             const Matrix& matrix);

} // namespace shadowproof
