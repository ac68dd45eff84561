// What stress finds as JSON of schema shadowproof/stress/1 (docs/stress.schema.json).
#pragma once

#include "compare/json/json_file.h"
#include "compare/stress/stress_run.h"

#include <string_view>

namespace shadowproof {

inline constexpr std::string_view stress_schema = "shadowproof/stress/1";

/// `points` has one entry for each technique at each value; the truth is the technique "truth",
/// with what the witness said.
ResultsJson stress_json(const StressRun& run);

} // namespace shadowproof
