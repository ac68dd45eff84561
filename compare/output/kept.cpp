#include "compare/output/kept.h"

#include "compare/output/descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

struct Found {
    std::string name; ///< relative
    bool is_folder = false;
};

/// All below, sorted: folders come before what they hold.
std::vector<Found> all_below(const fs::path& folder) {
    std::vector<Found> all;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        all.push_back({entry.path().lexically_relative(folder).generic_string(),
                       fs::is_directory(entry.symlink_status())});
    std::sort(all.begin(), all.end(),
              [](const Found& a, const Found& b) { return fs::path(a.name) < fs::path(b.name); });
    return all;
}

/// The folders in `to` down to the one called `name`.
void make_folders(const fs::path& name, const fs::path& to) {
    if (name.empty()) return;
    make_folders(name.parent_path(), to);
    if (::mkdir((to / name).c_str(), 0700) == 0) return;
    const int reason = errno;
    struct stat status {};
    if (reason == EEXIST && ::lstat((to / name).c_str(), &status) == 0 && S_ISDIR(status.st_mode))
        return;
    throw std::system_error(reason, std::generic_category());
}

/// A folder that is to be emptied may have taken over a mode that forbids it.
void make_writable(const fs::path& folder) {
    if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) ::chmod(folder.c_str(), 0700);
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    struct stat one {};
    struct stat other {};
    if (::lstat(a.c_str(), &one) != 0) throw_errno();
    if (::lstat(b.c_str(), &other) == 0)
        return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
    if (errno != ENOENT && errno != ENOTDIR) throw_errno();
    return false;
}

void move_home(const std::string& name, const fs::path& folder, const fs::path& home) {
    make_folders(fs::path(name).parent_path(), home);
    fs::path place = home / name;
    for (int number = 1;; ++number) {
        if (::renameat2(AT_FDCWD, (folder / name).c_str(), AT_FDCWD, place.c_str(),
                        RENAME_NOREPLACE) == 0)
            return;
        if (errno == EINVAL || errno == ENOSYS) { // the file system has no such renaming
            if (::linkat(AT_FDCWD, (folder / name).c_str(), AT_FDCWD, place.c_str(), 0) == 0 &&
                ::unlink((folder / name).c_str()) == 0)
                return;
        }
        if (errno != EEXIST) throw_errno();
        place = home / fmt::format("{}.kept-{}", name, number);
    }
}

} // namespace

std::vector<KeptFile> kept_in(const fs::path& folder, const Manifest& manifest) {
    std::vector<KeptFile> kept;
    for (const Found& found : all_below(folder)) {
        if (found.name == manifest_name) continue;
        if (found.is_folder) {
            if (!lists_below(manifest, found.name)) kept.push_back({found.name, true, false});
            continue;
        }
        const auto entry = manifest.find(found.name);
        const bool listed = entry != manifest.end();
        const fs::path file = folder / found.name;
        const bool regular = fs::is_regular_file(fs::symlink_status(file));
        if (listed && regular && fs::file_size(file) == entry->second.size &&
            fingerprint_of(file) == entry->second)
            continue;
        kept.push_back({found.name, false, listed});
    }
    return kept;
}

void link_kept(const KeptFile& kept, const fs::path& from, const fs::path& to) {
    if (kept.is_folder) return make_folders(kept.name, to);
    make_folders(fs::path(kept.name).parent_path(), to);
    if (::linkat(AT_FDCWD, (from / kept.name).c_str(), AT_FDCWD, (to / kept.name).c_str(), 0) != 0)
        throw_errno();
}

void take_over_folder_modes(const std::vector<KeptFile>& kept, const fs::path& from,
                            const fs::path& to) {
    std::set<fs::path> folders;
    for (const KeptFile& each : kept) {
        if (each.is_folder) folders.insert(each.name);
        for (fs::path above = fs::path(each.name).parent_path(); !above.empty();
             above = above.parent_path())
            folders.insert(above);
    }
    // From the bottom: a folder whose new mode forbids access is done after those below it.
    for (auto name = folders.rbegin(); name != folders.rend(); ++name)
        take_over_mode(from / *name, to / *name);
}

void take_over_mode(const fs::path& from, const fs::path& to) {
    struct stat status {};
    if (::stat(from.c_str(), &status) != 0) throw_errno();
    if (::chown(to.c_str(), status.st_uid, status.st_gid) != 0 && !may_not_give_away(errno))
        throw_errno();
    if (::chmod(to.c_str(), status.st_mode & 07777U) != 0) throw_errno();
}

std::vector<std::string> empty_out(const fs::path& folder, const fs::path& home,
                                   const FateOf& fate_of) {
    std::vector<std::string> left;
    std::vector<Found> all = all_below(folder);
    std::reverse(all.begin(), all.end());
    // The manifest is removed last: without it no process could continue after an interruption.
    std::stable_partition(all.begin(), all.end(),
                          [](const Found& found) { return found.name != manifest_name; });
    make_writable(folder);
    for (const Found& found : all)
        if (found.is_folder) make_writable(folder / found.name);
    for (const Found& found : all) {
        const fs::path file = folder / found.name;
        if (found.is_folder) {
            if (::rmdir(file.c_str()) != 0 && errno != ENOTEMPTY && errno != EEXIST) throw_errno();
            continue;
        }
        const Fate fate =
            is_same_file(file, home / found.name) ? Fate::remove : fate_of(found.name, file);
        if (fate == Fate::leave) left.push_back(found.name);
        if (fate == Fate::bring_home) move_home(found.name, folder, home);
        if (fate == Fate::remove && ::unlink(file.c_str()) != 0) throw_errno();
    }
    if (::rmdir(folder.c_str()) != 0 && errno != ENOTEMPTY && errno != EEXIST) throw_errno();
    return left;
}

} // namespace shadowproof
