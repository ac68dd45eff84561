// Rebuilds a report from the results and pictures of earlier runs, for the commands report and
// merge.
#pragma once

#include "scenes/memory_budget.h"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace shadowproof {

enum class Rebuilt { one_run, several };

struct RebuildOptions {
    Rebuilt what = Rebuilt::one_run; ///< several are joined; of one run, a shard stays one
    std::vector<std::string> from; ///< report folders, or results.json files beside their pictures
    std::string out = "report";
    std::string json;
    bool quiet = false;
    MemoryBudget memory{};
};

/// --out, --memory and -q.
void add_rebuild_flags(CLI::App& command, RebuildOptions& options);

/// A new report replaces the folder at `out` whole. Results that lie there themselves are in the
/// new one; others below it would be lost: throws Error naming the folder.
void refuse_to_lose(const std::filesystem::path& results, const std::filesystem::path& out);

/// In a process of its own, joins the results, takes over their pictures and data, and writes the
/// report; says which of them are missing or damaged. Returns the exit code that the results
/// deserve. Throws Error where results are damaged or do not belong together.
int rebuild(const RebuildOptions& options);

} // namespace shadowproof
