#include "compare/output/folder_lock.h"

#include "compare/output/unwritable.h"
#include "scenes/error.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = "lock";
/// What a lock of this program begins with; the rest of the line names its holder.
constexpr std::string_view signature = "shadowproof is writing a report here: ";

/// "process 4711 on host, since 2024-01-31T23:59:59Z"
std::string holder_of_this_process() {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host = {"this machine"};
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("process {} on {}, since {:%Y-%m-%dT%H:%M:%SZ}", getpid(), host.data(),
                       fmt::gmtime(now));
}

std::string first_line(const Descriptor& file) {
    std::array<char, 512> head{};
    const ssize_t got = ::pread(file.number(), head.data(), head.size(), 0);
    if (got < 0) throw_errno();
    const std::string_view text(head.data(), static_cast<std::size_t>(got));
    return std::string(text.substr(0, text.find('\n')));
}

/// Replaces an earlier holder's text in one step, so that the lock is never without a signature.
void sign(const Descriptor& file) {
    const std::string line = fmt::format("{}{}\n", signature, holder_of_this_process());
    errno = 0;
    if (::pwrite(file.number(), line.data(), line.size(), 0) != static_cast<ssize_t>(line.size())) {
        if (errno == 0) errno = ENOSPC;
        throw_errno();
    }
    if (::ftruncate(file.number(), static_cast<off_t>(line.size())) != 0) throw_errno();
}

[[noreturn]] void refuse_foreign(const fs::path& work) {
    throw Error(work.string(),
                "is in the way: reports are written there, and it was not made by this program",
                "move it away, or name another folder with --out");
}

[[noreturn]] void refuse_held(const fs::path& report, const std::string& line) {
    const bool signed_by = line.starts_with(signature);
    throw Error(report.string(),
                fmt::format("is being written by {}",
                            signed_by ? line.substr(signature.size()) : "another process"),
                "wait for it, or name another folder with --out");
}

bool is_lock_at(const fs::path& name, const Descriptor& file) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(file.number(), &opened) == 0 && ::lstat(name.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Locked, or false where another process has it and keeps it. A killed run ends before its
/// children, which share its lock: the next process waits for them.
bool take(const Descriptor& file) {
    constexpr int most_tries = 200;
    constexpr std::chrono::milliseconds moment{10};
    for (int i = 0; i < most_tries; ++i) {
        if (::flock(file.number(), LOCK_EX | LOCK_NB) == 0) return true;
        if (errno != EWOULDBLOCK && errno != EINTR) throw_errno();
        std::this_thread::sleep_for(moment);
    }
    return false;
}

bool holds_nothing_but_lock(const fs::path& work) {
    for (const fs::directory_entry& entry : fs::directory_iterator(work))
        if (entry.path().filename() != lock_name) return false;
    return true;
}

/// The existing lock; none if it has disappeared meanwhile.
std::optional<Descriptor> take_over(const fs::path& work, const fs::path& report) {
    const fs::path name = work / lock_name;
    struct stat status {};
    if (::lstat(name.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) refuse_foreign(work);
    Descriptor file = open_file(name, O_RDWR | O_NOFOLLOW | O_NONBLOCK);
    const std::string line = first_line(file);
    // If files are named before they have content, a process may be killed between the two.
    const bool ours = line.starts_with(signature) || (line.empty() && holds_nothing_but_lock(work));
    if (!ours) refuse_foreign(work);
    if (!take(file)) refuse_held(report, line);
    if (!is_lock_at(name, file)) return std::nullopt;
    sign(file);
    return file;
}

/// A new lock, signed and locked when it appears; none if another appeared before.
std::optional<Descriptor> make(const fs::path& work, const fs::path& report) {
    const fs::path name = work / lock_name;
    Descriptor file;
    try {
        file = open_file(work, O_TMPFILE | O_RDWR);
    } catch (const std::system_error& error) {
        const int reason = error.code().value();
        if (reason == ENOENT) return std::nullopt;
        if (reason != EOPNOTSUPP && reason != EISDIR && reason != EINVAL) throw;
    }
    if (file) {
        static_cast<void>(take(file)); // no other process has it
        sign(file);
        const std::string itself = fmt::format("/proc/self/fd/{}", file.number());
        if (::linkat(AT_FDCWD, itself.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0)
            return file;
        if (errno == EEXIST || errno == ENOENT) return std::nullopt;
        throw_errno();
    }
    try {
        file = open_file(name, O_CREAT | O_EXCL | O_RDWR);
    } catch (const std::system_error& error) {
        const int reason = error.code().value();
        if (reason == EEXIST || reason == ENOENT) return std::nullopt;
        throw;
    }
    try {
        if (!take(file)) refuse_held(report, first_line(file));
        sign(file);
    } catch (...) {
        ::unlink(name.c_str());
        throw;
    }
    return file;
}

std::optional<Descriptor> try_lock(const fs::path& work, const fs::path& report) {
    if (::mkdir(work.c_str(), 0777) != 0 && errno != EEXIST) throw_errno();
    const fs::file_status status = fs::symlink_status(work);
    if (!fs::exists(status)) return std::nullopt;
    if (!fs::is_directory(status)) refuse_foreign(work);
    if (fs::exists(fs::symlink_status(work / lock_name))) return take_over(work, report);
    // Its holder removes the lock last: a folder without a lock is empty, or not this program's.
    if (!holds_nothing_but_lock(work)) refuse_foreign(work);
    return make(work, report);
}

} // namespace

FolderLock::FolderLock(const fs::path& work, const fs::path& report) : work_(work) {
    constexpr int most_holders = 100; // that came and went meanwhile
    try {
        for (int i = 0; i < most_holders && !file_; ++i)
            if (std::optional<Descriptor> file = try_lock(work, report)) file_ = std::move(*file);
        if (!file_) refuse_held(report, "");
    } catch (...) {
        ::rmdir(work.c_str()); // fails where anything is in it
        try {
            throw;
        } catch (const std::system_error& error) {
            throw unwritable_report(report, error.code().value());
        }
    }
}

void FolderLock::give_back() {
    if (!file_) return;
    constexpr int tries = 2; // a passing failure must not leave anything behind
    const fs::path name = work_ / lock_name;
    for (int i = 0; i < tries && ::unlink(name.c_str()) != 0 && errno != ENOENT; ++i) continue;
    for (int i = 0; i < tries && ::rmdir(work_.c_str()) != 0; ++i)
        if (errno == ENOTEMPTY || errno == ENOENT) break; // another process has taken it already
    file_ = Descriptor();
}

} // namespace shadowproof
