// What docs/results.schema.json says, as code: Debian has no library for JSON Schema in C++.
#pragma once

#include "compare/results_file.h"

#include <string>
#include <string_view>

namespace shadowproof {

/// Throws Error naming `file`, the JSON pointer of the first value that is not as it must be, and
/// the remedy. Beside the schema's rules: sums and cause maps must say what the counts say, and
/// pictures lie in the folder of their scene.
void check_results(const ResultsJson& results, const std::string& file);

/// "^[A-Za-z0-9_-]+$": a folder's name that leads nowhere else.
bool is_plain_name(std::string_view name);

/// Does the scene, or the cell, tell why it could not run, and nothing else?
bool could_not_run(const ResultsJson& scene_or_cell);

/// Does anything in the scene fail the run?
bool scene_fails(const ResultsJson& scene);

} // namespace shadowproof
