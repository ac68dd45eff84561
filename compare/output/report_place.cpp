#include "compare/output/report_place.h"

#include "compare/output/manifest.h"
#include "compare/output/unwritable.h"
#include "scenes/error.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// What marks a folder under version control: git (a folder, or a file in a work tree), Mercurial,
/// Subversion, Bazaar, Darcs, Jujutsu, CVS, Fossil (two names) and Pijul.
constexpr std::array version_control{".git", ".hg", ".svn",      ".bzr",     "_darcs",
                                     ".jj",  "CVS", ".fslckout", "_FOSSIL_", ".pijul"};

[[noreturn]] void refuse(const fs::path& named, const std::string& what) {
    throw Error(named.string(), what, "name another folder with --out");
}

/// Of the accounts that this machine itself knows; those of a network's directory are not asked
/// for, which may be many and slow.
constexpr const char* accounts_file = "/etc/passwd";

fs::path home_of(uid_t user) {
    const passwd* entry = ::getpwuid(user); // called by one thread, before the work
    return entry != nullptr && entry->pw_dir != nullptr ? entry->pw_dir : "";
}

bool holds(const fs::path& folder, const fs::path& path) {
    const fs::path relative = path.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

void refuse_folders_of_people(const fs::path& named, const fs::path& place) {
    std::error_code ignored;
    if (holds(place, fs::current_path(ignored)))
        refuse(named, "is the current folder, or holds it, and a report replaces its folder");
    const char* const home = std::getenv("HOME");
    std::vector<fs::path> homes = homes_in(accounts_file);
    homes.insert(homes.end(), {home != nullptr ? home : "", home_of(::getuid()),
                               home_of(::geteuid()), home_of(0), "/root"});
    for (const fs::path& each : homes)
        if (each.is_absolute() && holds(place, fs::weakly_canonical(each, ignored)))
            refuse(named, "is a home folder, or holds one, and a report replaces its folder");
}

bool is_mount_point(const fs::path& folder) {
    struct statx status {};
    if (::statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &status) == 0 &&
        (status.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0)
        return (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
    // Kernels before 5.8 do not report it; another file system still shows by its device.
    struct stat own {};
    struct stat above {};
    return ::stat(folder.c_str(), &own) == 0 && ::stat(folder.parent_path().c_str(), &above) == 0 &&
           own.st_dev != above.st_dev;
}

/// Older versions of this program wrote no manifest: their reports are recognised by the schema in
/// the first bytes of results.json.
bool is_report_without_manifest(const fs::path& folder) {
    std::error_code ignored;
    const fs::path file = folder / "results.json";
    if (!fs::is_regular_file(fs::symlink_status(file, ignored))) return false;
    std::ifstream results(file, std::ios::binary);
    std::string head(64, '\0');
    results.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.find("\"shadowproof/results/") != std::string::npos;
}

std::optional<Manifest> manifest_of(const fs::path& named, const fs::path& place) {
    try {
        return read_manifest(place);
    } catch (const std::system_error& error) {
        throw unwritable_report(named, error.code().value());
    }
}

bool may_be_replaced(const Manifest& manifest, const std::string& name, const fs::path& file) {
    try {
        return is_as_listed(manifest, name, file);
    } catch (const std::system_error&) {
        return false;
    }
}

} // namespace

std::vector<fs::path> homes_in(const fs::path& accounts) {
    constexpr std::size_t most_accounts = 100'000;
    std::vector<fs::path> homes;
    const std::unique_ptr<std::FILE, decltype(&std::fclose)> file(
        std::fopen(accounts.c_str(), "re"), &std::fclose);
    if (!file) return homes;
    // Called by one thread, before the work.
    while (homes.size() < most_accounts) {
        const passwd* const entry = ::fgetpwent(file.get());
        if (entry == nullptr) break;
        homes.emplace_back(entry->pw_dir);
    }
    return homes;
}

void refuse_in_the_way(const fs::path& folder, const std::string& name) {
    throw Error((folder / name).string(),
                "is not as this program wrote it, and the new report has a file of that name",
                "move it away, or name another folder with --out");
}

void check_report_place(const fs::path& named, const fs::path& place,
                        const std::vector<std::string>& fixed) {
    if (place == place.root_path()) refuse(named, "is the root of the file system");
    refuse_folders_of_people(named, place);
    struct stat status {};
    if (::lstat(place.c_str(), &status) != 0) {
        if (errno == ENOENT) return;
        throw unwritable_report(named, errno);
    }
    if (!S_ISDIR(status.st_mode)) refuse(named, "is there already and is not a folder");
    if (is_mount_point(place))
        throw Error(named.string(), "is a mount point, which cannot be replaced",
                    "name a folder in it with --out");
    std::error_code error;
    for (const char* const name : version_control)
        if (fs::exists(fs::symlink_status(place / name, error)))
            refuse(named, std::string("is under version control (it holds ") + name + ")");
    const bool empty = fs::is_empty(place, error);
    if (error) throw unwritable_report(named, error.value());
    if (empty) return;
    const std::optional<Manifest> manifest = manifest_of(named, place);
    if (!manifest && is_report_without_manifest(place))
        throw Error(named.string(),
                    "is a report without manifest.json, as older versions of this program wrote "
                    "them, and what else lies in it cannot be told",
                    "remove it, or name another folder with --out");
    if (!manifest)
        throw Error(named.string(), "is there already and is not a report of this program",
                    "remove it, or name another folder with --out");
    for (const std::string& name : fixed)
        if (fs::exists(fs::symlink_status(place / name, error)) &&
            !may_be_replaced(*manifest, name, place / name))
            refuse_in_the_way(named, name);
}

} // namespace shadowproof
