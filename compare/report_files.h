// The pictures and data of a report taken over into another: each looked at, so that what is
// missing or damaged is named and never passes for agreement.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace shadowproof {

/// A file that one report has from another: a picture, or a script where it has an opening.
struct ReportFile {
    std::filesystem::path from;
    std::string to;          ///< relative to the new report
    std::uint64_t width = 0; ///< pixels, as the results say
    std::uint64_t height = 0;
    std::string opening;     ///< what the script begins with: shadowproof.scene("near_plane",
    std::string new_opening; ///< what it begins with in the new report
};

/// Copies it into `folder`, as it is also where it is damaged. Returns what is wrong with it, none
/// where nothing is. Throws Error where it cannot be written.
std::optional<std::string> take_over(const ReportFile& file, const std::filesystem::path& folder);

} // namespace shadowproof
