// results.json read back: refused by name where it is not what docs/results.schema.json says, or
// where its figures contradict each other. Members that a newer writer adds are let through.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace shadowproof {

inline constexpr std::string_view results_schema = "shadowproof/results/1";
/// Of the data beside the results: the viewer of one format does not read another's.
inline constexpr int results_format = 3;

using ResultsJson = nlohmann::ordered_json; ///< members in the order of the file

struct ResultsFile {
    std::filesystem::path path; ///< of the file itself; its pictures stand beside it
    ResultsJson json;
};

/// `path`: a results.json, or the folder of a report, which holds one. Throws Error naming the
/// file, the JSON pointer (RFC 6901) of what is wrong in it, and the remedy.
/// What it takes is kept in the account, where there is one.
ResultsFile read_results(const std::filesystem::path& path, MemoryAccount* memory = nullptr);

/// The same of a text; `file` names it in errors.
ResultsJson parse_results(const std::string& text, const std::string& file);

/// The file's text again: the same bytes for what shadowproof has written.
std::string results_text(const ResultsJson& results);

/// A value for a message: quoted, on one line, and short.
std::string shown(const ResultsJson& value);

} // namespace shadowproof
