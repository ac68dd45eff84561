// The error for a file or folder that cannot be written: the name that the user gave, the reason,
// and the remedy.
#pragma once

#include "scenes/error.h"

#include <filesystem>

namespace shadowproof {

/// "FILE: cannot be written (No space left on device); free some space, or name another place";
/// `reason`: an errno.
Error unwritable(const std::filesystem::path& file, int reason);
/// The same for the report in `folder`, or for a file of it.
Error unwritable_report(const std::filesystem::path& folder, int reason);

} // namespace shadowproof
