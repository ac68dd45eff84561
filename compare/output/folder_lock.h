// The folder that a report is written in, beside its place, and the lock in it: one process at a
// time writes a report.
#pragma once

#include "compare/output/descriptor.h"

#include <filesystem>
#include <string>

namespace shadowproof {

/// The lock of a work folder, held from here on by this process and the children that it forks.
class FolderLock {
public:
    FolderLock() = default;
    /// Makes the folder, or takes over what a dead process left. Throws Error naming `report`, the
    /// folder whose report is to be written: where another process holds the lock, with what it
    /// says of itself; where `work` is there and carries no lock of this program; and where it
    /// cannot be made.
    FolderLock(const std::filesystem::path& work, const std::filesystem::path& report);

    /// Removes the lock, and the folder where it is empty then.
    void give_back();
    explicit operator bool() const { return static_cast<bool>(file_); }

private:
    std::filesystem::path work_;
    Descriptor file_;
};

} // namespace shadowproof
