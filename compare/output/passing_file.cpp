#include "compare/output/passing_file.h"

#include "compare/output/manifest.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;
using Status = struct stat;

constexpr std::string_view prefix = ".shadowproof-";

/// Where a file must have a name before it has an inode, the name is made for this number. It
/// proves the making of an empty file alone.
constexpr ino_t no_inode = 0;

std::string proof_of(std::string_view beginning, ino_t inode) {
    const std::string words = fmt::format("{} {}", beginning, inode);
    return fingerprint_of(std::string_view(words)).xxh3;
}

std::string passing_name(ino_t inode) {
    static std::atomic<int> number = 0;
    const std::string beginning = fmt::format("{}{}-{}", prefix, getpid(), number++);
    return fmt::format("{}-{}", beginning, proof_of(beginning, inode));
}

bool is_proved(std::string_view name, const Status& status) {
    const std::size_t dash = name.rfind('-');
    if (!name.starts_with(prefix) || dash < prefix.size()) return false;
    const std::string_view beginning = name.substr(0, dash);
    const std::string_view proof = name.substr(dash + 1);
    return proof == proof_of(beginning, status.st_ino) ||
           (status.st_size == 0 && proof == proof_of(beginning, no_inode));
}

/// A file of somebody else gets its owner before it gets its name: root, who alone can do that, may
/// remove it.
bool is_own(const Status& status) {
    return status.st_uid == ::geteuid() || ::geteuid() == 0;
}

void remove_leftover(const fs::path& file, Writers writers) {
    Status named{};
    if (::lstat(file.c_str(), &named) != 0 || !S_ISREG(named.st_mode) || !is_own(named) ||
        !is_proved(file.filename().string(), named))
        return;
    if (writers == Writers::none) {
        ::unlink(file.c_str());
        return;
    }
    const Descriptor opened(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    Status status{};
    if (opened && ::flock(opened.number(), LOCK_EX | LOCK_NB) == 0 &&
        ::fstat(opened.number(), &status) == 0 && status.st_ino == named.st_ino &&
        is_proved(file.filename().string(), status))
        ::unlink(file.c_str());
}

bool takes_no_unnamed(int reason) {
    return reason == EOPNOTSUPP || reason == EISDIR || reason == EINVAL || reason == ENOENT;
}

Status status_of(const Descriptor& file) {
    Status status{};
    if (::fstat(file.number(), &status) != 0) throw_errno();
    return status;
}

void lock(const Descriptor& file) {
    // Not every file system has locks: what kill -9 leaves may then be taken for another run's, and
    // stays.
    static_cast<void>(::flock(file.number(), LOCK_EX | LOCK_NB));
}

/// None where another process took it for a leftover before it was locked.
PassingFile make_named(const fs::path& folder) {
    PassingFile made{{}, folder / passing_name(no_inode)};
    made.opened = open_file(made.name, O_CREAT | O_EXCL | O_WRONLY);
    try {
        lock(made.opened);
        const Status status = status_of(made.opened);
        const fs::path name = folder / passing_name(status.st_ino);
        if (::rename(made.name.c_str(), name.c_str()) == 0) {
            made.name = name;
            return made;
        }
        if (errno == ENOENT && status.st_nlink == 0) return {};
        throw_errno();
    } catch (...) {
        discard(made);
        throw;
    }
}

void give_name(const Descriptor& unnamed, const fs::path& name) {
    const std::string itself = fmt::format("/proc/self/fd/{}", unnamed.number());
    if (::linkat(AT_FDCWD, itself.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
        throw_errno();
}

void move_to(const fs::path& name, const fs::path& place) {
    if (::renameat2(AT_FDCWD, name.c_str(), AT_FDCWD, place.c_str(), RENAME_NOREPLACE) == 0) return;
    if (!cannot_rename_so(errno)) throw_errno();
    if (::linkat(AT_FDCWD, name.c_str(), AT_FDCWD, place.c_str(), 0) != 0) throw_errno();
    if (::unlink(name.c_str()) == 0) return;
    const int reason = errno;
    ::unlink(place.c_str());
    throw std::system_error(reason, std::generic_category());
}

} // namespace

PassingFile make_passing_file(const fs::path& folder) {
    try {
        return {open_file(folder, O_TMPFILE | O_WRONLY), {}};
    } catch (const std::system_error& error) {
        if (!takes_no_unnamed(error.code().value())) throw;
    }
    constexpr int most_tries = 100;
    for (int i = 0; i < most_tries; ++i)
        if (PassingFile made = make_named(folder); made.opened) return made;
    throw std::system_error(EBUSY, std::generic_category());
}

void name_in_passing(PassingFile& file, const fs::path& folder) {
    if (!file.name.empty()) return;
    lock(file.opened);
    const fs::path name = folder / passing_name(status_of(file.opened).st_ino);
    give_name(file.opened, name);
    file.name = name;
}

void put_at_place(PassingFile& file, const fs::path& place) {
    if (file.name.empty())
        give_name(file.opened, place);
    else
        move_to(file.name, place);
    file.name.clear();
    try {
        file.opened.close();
    } catch (...) {
        ::unlink(place.c_str()); // not all of it may have been written
        throw;
    }
}

void discard(const PassingFile& file) noexcept {
    if (!file.name.empty()) ::unlink(file.name.c_str());
}

void remove_leftovers(const fs::path& folder, Writers writers) {
    std::error_code ignored;
    fs::directory_iterator entries(folder, ignored);
    while (entries != fs::directory_iterator()) {
        remove_leftover(entries->path(), writers);
        entries.increment(ignored);
    }
}

} // namespace shadowproof
