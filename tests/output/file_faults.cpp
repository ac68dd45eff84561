// A shared object for LD_PRELOAD: file operations of a program that fail where a test says so. It
// counts the calls that touch anything below one folder, by path or by open file, in all processes
// that the program forks. Set by environment variables:
//   FAULTS_BELOW    the folder; without it nothing is counted
//   FAULTS_COUNTER  a file of 16 bytes: calls so far, and the process that began, as uint64
//   FAULTS_AT       the call that fails, from 1; none: all are counted and none fails
//   FAULTS_ERRNO    with which errno (EIO)
//   FAULTS_KILL     set: instead of failing, the call ends all processes by SIGKILL
//   FAULTS_WITHOUT  what the file system does not have: "unnamed" files, "exchange" of two names,
//                   or both, with a comma between
//   FAULTS_CHANGES  set: calls that only read or ask are not counted
//   FAULTS_LOG      a file with a line for each call that writes, syncs, links or renames: the call
//                   and the path, relative to the folder, "." itself
//   FAULTS_BYTES    from that many bytes written below the folder on, writing fails (ENOSPC)
#include "tests/output/file_faults.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace file_faults {

namespace {

struct Shared {
    std::atomic<unsigned long> calls;
    std::atomic<unsigned long> first_process;
};

struct Settings {
    char below[PATH_MAX] = "";
    std::size_t length = 0;
    unsigned long at = 0;
    int reason = EIO;
    bool kill = false;
    bool changes_alone = false;
    bool without_unnamed = false;
    bool without_exchange = false;
    bool has_budget = false;
    std::atomic<long> budget = 0; ///< bytes that may still be written
    int log = -1;
    Shared* shared = nullptr;

    Settings();
};

Settings::Settings() {
    const char* const folder = std::getenv("FAULTS_BELOW");
    const char* const counter = std::getenv("FAULTS_COUNTER");
    if (folder == nullptr || counter == nullptr ||
        original<char*(const char*, char*)>("realpath")(folder, below) == nullptr)
        return;
    length = std::strlen(below);
    if (const char* text = std::getenv("FAULTS_AT")) at = std::strtoul(text, nullptr, 10);
    if (const char* text = std::getenv("FAULTS_ERRNO")) reason = std::atoi(text);
    kill = std::getenv("FAULTS_KILL") != nullptr;
    changes_alone = std::getenv("FAULTS_CHANGES") != nullptr;
    if (const char* text = std::getenv("FAULTS_WITHOUT")) {
        without_unnamed = std::strstr(text, "unnamed") != nullptr;
        without_exchange = std::strstr(text, "exchange") != nullptr;
    }
    if (const char* text = std::getenv("FAULTS_BYTES")) {
        has_budget = true;
        budget = std::atol(text);
    }
    if (const char* text = std::getenv("FAULTS_LOG"))
        log = original<int(const char*, int, ...)>("open")(text, O_WRONLY | O_APPEND | O_CLOEXEC);
    const int file = original<int(const char*, int, ...)>("open")(counter, O_RDWR | O_CLOEXEC);
    void* const mapped =
        file < 0 ? MAP_FAILED
                 : mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0) original<int(int)>("close")(file);
    if (mapped == MAP_FAILED) return;
    shared = static_cast<Shared*>(mapped);
    unsigned long none = 0;
    shared->first_process.compare_exchange_strong(none, static_cast<unsigned long>(getpid()));
}

Settings& settings() {
    static auto* const the_one = new Settings;
    return *the_one;
}

/// Ends the process that began, the one that waits for this one, and this one. Each in between
/// would otherwise live long enough to report that its child was killed.
[[noreturn]] void kill_all(const Settings& set) {
    const auto first = static_cast<pid_t>(set.shared->first_process.load());
    const pid_t parent = getppid();
    kill(first, SIGKILL);
    if (getpid() != first && parent > 1) kill(parent, SIGKILL);
    kill(getpid(), SIGKILL);
    for (;;) pause();
}

bool path_of(int descriptor, char (&path)[PATH_MAX]) {
    char name[64];
    std::snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
    const ssize_t length =
        original<ssize_t(const char*, char*, std::size_t)>("readlink")(name, path, sizeof path - 1);
    if (length <= 0) return false;
    path[length] = '\0';
    return true;
}

} // namespace

bool is_below(const char* path) {
    const Settings& set = settings();
    return set.shared != nullptr && std::strncmp(path, set.below, set.length) == 0 &&
           (path[set.length] == '/' || path[set.length] == '\0');
}

bool is_below(int descriptor) {
    char path[PATH_MAX];
    return settings().shared != nullptr && path_of(descriptor, path) && is_below(path);
}

bool is_below(int folder, const char* path) {
    if (settings().shared == nullptr || path == nullptr) return false;
    if (path[0] == '/') return is_below(path);
    if (folder != AT_FDCWD) return is_below(folder);
    char current[PATH_MAX];
    char whole[PATH_MAX];
    if (getcwd(current, sizeof current) == nullptr) return false;
    const int length = std::snprintf(whole, sizeof whole, "%s/%s", current, path);
    return length > 0 && static_cast<std::size_t>(length) < sizeof whole && is_below(whole);
}

void record(const char* call, const char* path) {
    const Settings& set = settings();
    if (set.log < 0 || !is_below(path)) return;
    const int before = errno;
    const char* const relative = path[set.length] == '/' ? path + set.length + 1 : ".";
    char line[PATH_MAX + 64];
    const int length = std::snprintf(line, sizeof line, "%s %s\n", call, relative);
    // One that is cut is missed by the test.
    static_cast<void>(!original<ssize_t(int, const void*, std::size_t)>("write")(
        set.log, line, static_cast<std::size_t>(length)));
    errno = before;
}

void record(const char* call, int descriptor) {
    char path[PATH_MAX];
    if (settings().log >= 0 && path_of(descriptor, path)) record(call, path);
}

bool fails(bool counted) {
    const int before = errno;
    Settings& set = settings();
    if (!counted || set.shared == nullptr || set.shared->calls.fetch_add(1) + 1 != set.at) {
        errno = before;
        return false;
    }
    if (set.kill) kill_all(set);
    errno = set.reason;
    return true;
}

bool fails_to_ask(bool counted) {
    return !settings().changes_alone && fails(counted);
}

std::size_t granted(int descriptor, std::size_t bytes) {
    Settings& set = settings();
    if (!set.has_budget || !is_below(descriptor)) return bytes;
    const long left = set.budget.fetch_sub(static_cast<long>(bytes));
    if (left >= static_cast<long>(bytes)) return bytes;
    set.budget = 0;
    return left > 0 ? static_cast<std::size_t>(left) : 0;
}

bool lacks_unnamed(int folder, const char* path, int flags) {
    if (!settings().without_unnamed || (flags & O_TMPFILE) != O_TMPFILE || !is_below(folder, path))
        return false;
    errno = EOPNOTSUPP;
    return true;
}

bool lacks_exchange(int folder, const char* path, unsigned flags) {
    if (!settings().without_exchange || flags == 0 || !is_below(folder, path)) return false;
    errno = EINVAL;
    return true;
}

} // namespace file_faults
