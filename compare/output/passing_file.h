// Files that are being written and not yet at their place: without a name where the file system has
// that (O_TMPFILE), else under a passing one. A passing name proves that its file is of this
// program's making: it ends in a hash of its beginning and of the file's inode number, which no
// name given by somebody else has by chance, nor a copy of such a file.
#pragma once

#include "compare/output/descriptor.h"

#include <filesystem>

namespace shadowproof {

struct PassingFile {
    Descriptor opened;
    std::filesystem::path name; ///< empty: it has none
};

/// A new one, empty. It is locked where the file system has locks, so that other running processes
/// do not take it for a leftover. Throws std::system_error.
PassingFile make_passing_file(const std::filesystem::path& folder);

/// Gives it a passing name in `folder` if it has none. Throws std::system_error.
void name_in_passing(PassingFile& file, const std::filesystem::path& folder);

/// Closes it under the name `place`, in the same file system, where nothing may be yet (EEXIST).
/// Throws std::system_error; what has no name then is gone.
void put_at_place(PassingFile& file, const std::filesystem::path& place);

/// Where it is not put at its place after all. Never throws.
void discard(const PassingFile& file) noexcept;

/// Whether others may be writing into a folder.
enum class Writers { none, others };

/// Removes the files under passing names that killed processes have left in `folder`: regular files
/// of this process's user whose names prove their making. Those that another process has locked
/// stay, unless there can be none.
void remove_leftovers(const std::filesystem::path& folder, Writers writers);

} // namespace shadowproof
