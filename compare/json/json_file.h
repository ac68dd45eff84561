// Files of JSON as text and values: how this program writes them and, within a budget of memory,
// reads them back. Their values are checked elsewhere.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
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

/// Results nest nine deep. Parsing is recursive, and a file must not make the stack overflow.
inline constexpr int deepest_json = 64;

/// Throws Error where there is no such file, or no regular one: a FIFO would wait for a writer, and
/// a device never ends.
void require_json_file(const std::filesystem::path& file, const JsonRemedies& remedies);

/// Throws Error: where a parser stopped, in a file of `size` bytes; past the last one, the error is
/// that it ends.
[[noreturn]] void throw_not_json(const std::string& file, std::uint64_t size, std::uint64_t byte,
                                 const JsonRemedies& remedies);

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
