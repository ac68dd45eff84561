// What a process writes down about the folder that it is filling, so that another process can
// finish the writing, or clean up behind it.
#pragma once

#include "compare/output/descriptor.h"
#include "compare/output/manifest.h"

#include <filesystem>
#include <set>
#include <string>

namespace shadowproof {

/// A folder, whatever it is called by now.
struct FolderIdentity {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;

    bool operator==(const FolderIdentity&) const = default;
};
/// Throws std::system_error.
FolderIdentity identity_of(const std::filesystem::path& folder);

struct JournalRecord {
    std::optional<FolderIdentity> folder; ///< that is filled; none: the journal does not say
    std::set<std::string> begun;          ///< names of the files that are or will be created
    Manifest written;                     ///< those that are complete
    std::set<std::string> kept;           ///< names of what was in the folder that is replaced
};

/// Appends lines, each by one call, so that several threads and processes may. A line begins with a
/// line feed too: one that was cut short spoils no other. Throws std::system_error.
class Journal {
public:
    Journal() = default;
    /// Begins a new one.
    Journal(const std::filesystem::path& file, const FolderIdentity& folder);

    void begin(const std::string& name) const;
    void complete(const std::string& name, const Fingerprint& fingerprint) const;
    void keep(const std::string& name) const;

private:
    Descriptor file_;
};

/// An empty record where there is no journal. Throws std::system_error where it cannot be read.
JournalRecord read_journal(const std::filesystem::path& file);

} // namespace shadowproof
