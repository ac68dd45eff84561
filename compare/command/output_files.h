// Files that a command writes besides its report, and those of them that lie in the report's
// folder: they are part of the report then.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace shadowproof {

enum class Output { results, other };

/// The name in the report of `out` that a file has which lies in it; none where it lies elsewhere,
/// or where `file` is empty.
std::optional<std::string> name_in_report(const std::string& file, const std::string& out);

/// Throws Error, naming the file, where it cannot be written: before the work, not after. In the
/// report's folder it must not take the name of a file of every report; results.json may be asked
/// for where it is the results that are.
void check_output(const std::string& file, const std::string& out, Output output);

/// Throws Error where two of the files that a command writes are one, or one of them is a file that
/// it reads: that would be lost. Names may be empty.
void check_apart(std::span<const std::string> written, std::span<const std::string> read);

} // namespace shadowproof
