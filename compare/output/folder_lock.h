// The lock of a work folder, in which a report is written beside its place: one process at a time
// writes a report.
#pragma once

#include "compare/output/descriptor.h"

#include <filesystem>
#include <string>

namespace shadowproof {

/// The lock of a work folder, held from here on by this process and the children that it forks.
class FolderLock {
public:
    FolderLock() = default;
    /// Makes the folder, or takes over one that a dead process left. Throws Error naming `report`,
    /// the folder of the report to be written: if another process holds the lock, with that
    /// process's description of itself; if `work` exists without a lock of this program; and if it
    /// cannot be made.
    FolderLock(const std::filesystem::path& work, const std::filesystem::path& report);

    /// Removes the lock, and the folder if it is then empty.
    void give_back();
    explicit operator bool() const { return static_cast<bool>(file_); }

private:
    std::filesystem::path work_;
    Descriptor file_;
};

} // namespace shadowproof
