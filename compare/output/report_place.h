// Which folders a report may be written to: a new one, an empty one, or an older report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shadowproof {

/// Throws Error if a folder must not be replaced. `named`: the folder as the user gave it, for the
/// message; `place`: the same without links. Refused are the current folder, the home of any
/// account in /etc/passwd, those that hold them, a mount point, a folder with version control in
/// it, and what is neither empty nor a report with a manifest. `fixed`: names that every report
/// has. A file of such a name that the older report's manifest does not list, or that was changed,
/// is refused too.
void check_report_place(const std::filesystem::path& named, const std::filesystem::path& place,
                        const std::vector<std::string>& fixed);

/// The homes that a file in the format of /etc/passwd names; none if it cannot be read.
std::vector<std::filesystem::path> homes_in(const std::filesystem::path& accounts);

/// Throws Error: `name`, in the folder, is not what this program wrote, and stands where the new
/// report has a file of its own.
[[noreturn]] void refuse_in_the_way(const std::filesystem::path& folder, const std::string& name);

} // namespace shadowproof
