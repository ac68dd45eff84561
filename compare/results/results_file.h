// Reads results.json. A file is refused, with the place named, if it violates
// docs/results.schema.json or its figures contradict each other. Unknown members, such as a newer
// writer's, are accepted.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace shadowproof {

inline constexpr std::string_view results_schema = "shadowproof/results/1";
/// Format of the data beside the results: a viewer reads only its own format.
inline constexpr int results_format = 5;

using ResultsJson = nlohmann::ordered_json; ///< members in the order of the file

struct ResultsFile {
    std::filesystem::path path; ///< of the file itself; its pictures stand beside it
    ResultsJson json;
};

/// `path`: a results.json, or the folder of a report, which holds one. Throws Error naming the
/// file, the JSON pointer (RFC 6901) of what is wrong in it, and the remedy. The memory that it
/// takes is charged to the account, if there is one.
ResultsFile read_results(const std::filesystem::path& path, MemoryAccount* memory = nullptr);

/// The same of a text; `file` names it in errors.
ResultsJson parse_results(const std::string& text, const std::string& file);

/// What to do about a file of JSON that is no good.
struct JsonRemedies {
    const char* name = "";  ///< where it is not there, or no file
    const char* whole = ""; ///< where its text is not the whole
};

/// The text of a file of JSON, and its values, which no schema was applied to yet. Both throw Error
/// naming the file; the first charges what the values will take to the account, if there is one.
std::string json_text(const std::filesystem::path& file, const JsonRemedies& remedies,
                      MemoryAccount* memory = nullptr);
ResultsJson parse_json(const std::string& text, const std::string& file,
                       const JsonRemedies& remedies);

/// The file's text again: the same bytes for what shadowproof has written.
std::string results_text(const ResultsJson& results);

/// A value for a message: quoted, on one line, and short.
std::string shown(const ResultsJson& value);

} // namespace shadowproof
