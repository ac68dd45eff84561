// Reads results.json. A file is refused, with the place named, if it violates
// docs/results.schema.json or its figures contradict each other. Unknown members, such as a newer
// writer's, are accepted.
#pragma once

#include "compare/json/json_file.h"
#include "scenes/memory_budget.h"

#include <filesystem>
#include <string>

namespace shadowproof {

struct ResultsFile {
    std::filesystem::path path; ///< of the file itself; its pictures stand beside it
    ResultsJson json;
};

inline constexpr JsonRemedies results_remedies{
    "name a results.json, or the folder of a report",
    "give the whole results.json that shadowproof wrote"};

/// A results.json, or the one in the folder of a report.
std::filesystem::path results_path(const std::filesystem::path& path);

/// `path`: a results.json, or the folder of a report, which holds one. Throws Error naming the
/// file, the JSON pointer (RFC 6901) of what is wrong in it, and the remedy. The memory that it
/// takes is charged to the account, if there is one.
ResultsFile read_results(const std::filesystem::path& path, MemoryAccount* memory = nullptr);

/// The same of a text; `file` names it in errors.
ResultsJson parse_results(const std::string& text, const std::string& file);

} // namespace shadowproof
