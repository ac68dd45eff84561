// Files in a report's folder that are not part of the report: they stay there when the report is
// replaced.
#pragma once

#include "compare/output/manifest.h"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace shadowproof {

struct KeptFile {
    std::string name; ///< relative to the folder
    bool is_folder = false;
    bool changed = false; ///< the manifest lists it, but it has changed since it was written
};

/// All below `folder` that the manifest does not list, or that has changed since; folders come
/// before what they hold. Folders that hold listed files are not among them. Links are not
/// followed. Throws std::system_error.
std::vector<KeptFile> kept_in(const std::filesystem::path& folder, const Manifest& manifest);

/// Links one of them into the folder `to` under the same name, by a hard link. Folders, and those
/// that hold it, are made anew, accessible to their owner alone. Throws std::system_error.
void link_kept(const KeptFile& kept, const std::filesystem::path& from,
               const std::filesystem::path& to);
/// To be called afterwards: copies mode and owner of all those folders. Throws std::system_error.
void take_over_folder_modes(const std::vector<KeptFile>& kept, const std::filesystem::path& from,
                            const std::filesystem::path& to);

/// Copies the mode, and the owner where that is allowed. Throws std::system_error.
void take_over_mode(const std::filesystem::path& from, const std::filesystem::path& to);

/// What to do with a file.
enum class Fate { remove, leave, bring_home };
using FateOf = std::function<Fate(const std::string& name, const std::filesystem::path& file)>;

/// Removes from `folder` the files that may be removed, and then empty folders, itself included. A
/// file that `home` has under the same name (another hard link to it) is removed here whatever its
/// fate. What is to be brought home is moved there, under another name if its own is taken. Returns
/// the names of what is left. Throws std::system_error.
std::vector<std::string> empty_out(const std::filesystem::path& folder,
                                   const std::filesystem::path& home, const FateOf& fate_of);

} // namespace shadowproof
