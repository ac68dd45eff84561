// The pictures and data of a report taken over into another: each looked at, so that what is
// missing or damaged is named and never passes for agreement.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace shadowproof {

class ReportFolder;

/// A file that one report has from another: a picture, or a script where it has an opening.
struct ReportFile {
    std::filesystem::path from;
    std::string to;          ///< relative to the new report
    std::uint64_t width = 0; ///< pixels, as the results say
    std::uint64_t height = 0;
    std::string opening;     ///< what the script begins with: shadowproof.scene("near_plane",
    std::string new_opening; ///< what it begins with in the new report
};

/// Copies it into `report`, as it is also where it is damaged. Returns what is wrong with it, none
/// where nothing is; what cannot be read at all is not there. Throws Error where it cannot be
/// written, or is more than the account has left.
std::optional<std::string> take_over(const ReportFile& file, const ReportFolder& report,
                                     const MemoryAccount& memory);

} // namespace shadowproof
