// The journal of a folder that a process is filling, from which another process can finish the work
// or clean up.
#pragma once

#include "compare/output/descriptor.h"
#include "compare/output/manifest.h"

#include <filesystem>
#include <set>
#include <string>

namespace shadowproof {

/// Tells the folders of one file system apart, independently of their names.
struct FolderIdentity {
    std::uint64_t device = 0; ///< another number on each machine that has mounted the file system
    std::uint64_t inode = 0;

    bool operator==(const FolderIdentity& other) const { return inode == other.inode; }
};
/// Throws std::system_error.
FolderIdentity identity_of(const std::filesystem::path& folder);

struct JournalRecord {
    std::optional<FolderIdentity> folder; ///< that is being filled; none if not known
    Manifest begun;                       ///< files that are or will be at their place, whole
    Manifest written;                     ///< those that are
    std::set<std::string> kept;           ///< names of files kept from the folder that is replaced
};

/// Appends lines, each in one call, so that several threads and processes may write. A line also
/// begins with a line feed, so that a truncated line does not spoil the next one. Throws
/// std::system_error.
class Journal {
public:
    Journal() = default;
    /// Begins a new one.
    Journal(const std::filesystem::path& file, const FolderIdentity& folder);
    /// Goes on with one.
    explicit Journal(const std::filesystem::path& file);

    void begin(const std::string& name, const Fingerprint& fingerprint) const;
    void complete(const std::string& name) const;
    /// It is not there any more.
    void drop(const std::string& name) const;
    void keep(const std::string& name) const;

private:
    Descriptor file_;
};

/// An empty record if there is no journal. Throws std::system_error where it cannot be read.
JournalRecord read_journal(const std::filesystem::path& file);

} // namespace shadowproof
