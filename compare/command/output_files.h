// Files that a command writes besides its report. Those in the report's folder are part of the
// report.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace shadowproof {

enum class Output { results, other };

/// The file's name relative to the report's folder `out`; none if it lies elsewhere or `file` is
/// empty.
std::optional<std::string> name_in_report(const std::string& file, const std::string& out);

/// Throws Error naming the file if it cannot be written. To be called before the work. In the
/// report's folder it must not have the name of a file of every report; only the results themselves
/// may be results.json.
void check_output(const std::string& file, const std::string& out, Output output);

/// Throws Error if two of the files that a command writes are the same, or one of them is a file
/// that it reads and would lose. Names may be empty.
void check_apart(std::span<const std::string> written, std::span<const std::string> read);

} // namespace shadowproof
