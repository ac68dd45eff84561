// Copies the pictures and data of one report into another. Each file is checked, so that what is
// missing or damaged is named and never passes for agreement.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace shadowproof {

class ReportFolder;

/// A file that one report takes from another: a picture, or a script if it has an opening.
struct ReportFile {
    std::filesystem::path from;
    std::string to;          ///< relative to the new report
    std::uint64_t width = 0; ///< pixels, as the results say
    std::uint64_t height = 0;
    std::string opening;     ///< what the script begins with: shadowproof.scene("near_plane",
    std::string new_opening; ///< what it begins with in the new report
    bool of_cell = false;    ///< written only where no earlier cell of the scene has the same
    /// Of a cell's picture: its path in the new results, changed where it is an earlier one's.
    nlohmann::ordered_json* place = nullptr;
};

/// Copies it into `report`, even if it is damaged. Returns what is wrong with it, or none; a file
/// that cannot be read counts as missing. Throws Error if it cannot be written, or needs more
/// memory than the account has left.
std::optional<std::string> take_over(const ReportFile& file, const ReportFolder& report,
                                     const MemoryAccount& memory);

} // namespace shadowproof
