// What lies in a report's folder besides the report: it stays where it is, whatever becomes of the
// report.
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
    bool changed = false; ///< the manifest lists it, but it is not what was written any more
};

/// All below `folder` that is not what the manifest says was written, folders before what they
/// hold; none of those that hold listed files. Links are not followed. Throws std::system_error.
std::vector<KeptFile> kept_in(const std::filesystem::path& folder, const Manifest& manifest);

/// Gives one of them its name in the folder `to` as well, by a hard link; folders are made again,
/// as are those that hold it, for their owner alone. Throws std::system_error.
void link_kept(const KeptFile& kept, const std::filesystem::path& from,
               const std::filesystem::path& to);
/// Afterwards: mode and owner of all those folders. Throws std::system_error.
void take_over_folder_modes(const std::vector<KeptFile>& kept, const std::filesystem::path& from,
                            const std::filesystem::path& to);

/// Takes over mode, and owner where that is allowed. Throws std::system_error.
void take_over_mode(const std::filesystem::path& from, const std::filesystem::path& to);

/// Says of a file what shall become of it.
enum class Fate { remove, leave, bring_home };
using FateOf = std::function<Fate(const std::string& name, const std::filesystem::path& file)>;

/// Empties `folder` of what may be removed, and of folders that are empty then; itself too. A file
/// that `home` has under the same name (the same file, by another hard link) is removed here
/// whatever its fate; what is to be brought home is moved there, beside what stands there under its
/// name. Returns the names of what is left. Throws std::system_error.
std::vector<std::string> empty_out(const std::filesystem::path& folder,
                                   const std::filesystem::path& home, const FateOf& fate_of);

} // namespace shadowproof
