// Files of JSON as text and values: how this program writes them and, within a budget of memory,
// reads them back. Their values are checked elsewhere.
#pragma once

#include "scenes/memory_budget.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace shadowproof {

using ResultsJson = nlohmann::ordered_json; ///< members in the order of the file

/// The remedies that errors about a JSON file name.
struct JsonRemedies {
    const char* name = "";  ///< where the file does not exist, or is no regular file
    const char* whole = ""; ///< where its text is incomplete
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
