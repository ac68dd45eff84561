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
//   FAULTS_BYTES    from that many bytes written below the folder on, writing fails (ENOSPC)
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

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
    bool without_unnamed = false;
    bool without_exchange = false;
    bool has_budget = false;
    std::atomic<long> budget = 0; ///< bytes that may still be written
    Shared* shared = nullptr;

    Settings();
};

template <class Function>
Function* original(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

Settings::Settings() {
    const char* const folder = std::getenv("FAULTS_BELOW");
    const char* const counter = std::getenv("FAULTS_COUNTER");
    if (folder == nullptr || counter == nullptr || realpath(folder, below) == nullptr) return;
    length = std::strlen(below);
    if (const char* text = std::getenv("FAULTS_AT")) at = std::strtoul(text, nullptr, 10);
    if (const char* text = std::getenv("FAULTS_ERRNO")) reason = std::atoi(text);
    kill = std::getenv("FAULTS_KILL") != nullptr;
    if (const char* text = std::getenv("FAULTS_WITHOUT")) {
        without_unnamed = std::strstr(text, "unnamed") != nullptr;
        without_exchange = std::strstr(text, "exchange") != nullptr;
    }
    if (const char* text = std::getenv("FAULTS_BYTES")) {
        has_budget = true;
        budget = std::atol(text);
    }
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

bool is_below(const char* path) {
    const Settings& set = settings();
    return set.shared != nullptr && std::strncmp(path, set.below, set.length) == 0 &&
           (path[set.length] == '/' || path[set.length] == '\0');
}

bool is_below(int descriptor) {
    if (settings().shared == nullptr) return false;
    char name[64];
    char path[PATH_MAX];
    std::snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(name, path, sizeof path - 1);
    if (length <= 0) return false;
    path[length] = '\0';
    return is_below(path);
}

/// A path as a call gets it: relative to a folder that is open, or to the current one.
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

/// Counts a call; whether it is the one that fails.
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

/// How many of `bytes` still fit: fewer, where the budget ends among them.
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

mode_t mode_of(int flags, va_list arguments) {
    const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return has_mode ? va_arg(arguments, mode_t) : 0;
}

} // namespace

// The names and types are the C library's.
extern "C" {

int open(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_of(flags, arguments);
    va_end(arguments);
    if (lacks_unnamed(AT_FDCWD, path, flags) || fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, int, ...)>("open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_of(flags, arguments);
    va_end(arguments);
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, int, ...)>("open64")(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_of(flags, arguments);
    va_end(arguments);
    if (fails(is_below(folder, path))) return -1;
    return original<int(int, const char*, int, ...)>("openat")(folder, path, flags, mode);
}

int openat64(int folder, const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_of(flags, arguments);
    va_end(arguments);
    if (fails(is_below(folder, path))) return -1;
    return original<int(int, const char*, int, ...)>("openat64")(folder, path, flags, mode);
}

ssize_t read(int file, void* to, size_t count) {
    if (fails(is_below(file))) return -1;
    return original<ssize_t(int, void*, size_t)>("read")(file, to, count);
}

ssize_t write(int file, const void* from, size_t count) {
    if (fails(is_below(file))) return -1;
    const std::size_t taken = granted(file, count);
    if (taken == 0 && count > 0) {
        errno = ENOSPC;
        return -1;
    }
    return original<ssize_t(int, const void*, size_t)>("write")(file, from, taken);
}

ssize_t pwrite(int file, const void* from, size_t count, off_t offset) {
    if (fails(is_below(file))) return -1;
    return original<ssize_t(int, const void*, size_t, off_t)>("pwrite")(file, from, count, offset);
}

ssize_t pwrite64(int file, const void* from, size_t count, off64_t offset) {
    if (fails(is_below(file))) return -1;
    return original<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(file, from, count,
                                                                            offset);
}

/// Fails as Linux does: the descriptor is closed all the same.
int close(int file) {
    const bool failed = fails(is_below(file));
    const int reason = errno;
    const int closed = original<int(int)>("close")(file);
    if (!failed) return closed;
    errno = reason;
    return -1;
}

int fsync(int file) {
    if (fails(is_below(file))) return -1;
    return original<int(int)>("fsync")(file);
}

int syncfs(int file) {
    if (fails(is_below(file))) return -1;
    return original<int(int)>("syncfs")(file);
}

int ftruncate(int file, off_t length) {
    if (fails(is_below(file))) return -1;
    return original<int(int, off_t)>("ftruncate")(file, length);
}

int ftruncate64(int file, off64_t length) {
    if (fails(is_below(file))) return -1;
    return original<int(int, off64_t)>("ftruncate64")(file, length);
}

int flock(int file, int operation) {
    if (fails(is_below(file))) return -1;
    return original<int(int, int)>("flock")(file, operation);
}

int fchmod(int file, mode_t mode) {
    if (fails(is_below(file))) return -1;
    return original<int(int, mode_t)>("fchmod")(file, mode);
}

int fchown(int file, uid_t user, gid_t group) {
    if (fails(is_below(file))) return -1;
    return original<int(int, uid_t, gid_t)>("fchown")(file, user, group);
}

int chmod(const char* path, mode_t mode) {
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, mode_t)>("chmod")(path, mode);
}

int chown(const char* path, uid_t user, gid_t group) {
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, uid_t, gid_t)>("chown")(path, user, group);
}

int mkdir(const char* path, mode_t mode) {
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, mode_t)>("mkdir")(path, mode);
}

int rmdir(const char* path) {
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*)>("rmdir")(path);
}

int unlink(const char* path) {
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*)>("unlink")(path);
}

int unlinkat(int folder, const char* path, int flags) {
    if (fails(is_below(folder, path))) return -1;
    return original<int(int, const char*, int)>("unlinkat")(folder, path, flags);
}

int remove(const char* path) {
    if (fails(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*)>("remove")(path);
}

int rename(const char* from, const char* to) {
    if (fails(is_below(AT_FDCWD, to))) return -1;
    return original<int(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned int flags) {
    if (fails(is_below(to_folder, to))) return -1;
    if (settings().without_exchange && flags != 0 && is_below(to_folder, to)) {
        errno = EINVAL;
        return -1;
    }
    return original<int(int, const char*, int, const char*, unsigned int)>("renameat2")(
        from_folder, from, to_folder, to, flags);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    if (fails(is_below(to_folder, to))) return -1;
    return original<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from,
                                                                            to_folder, to, flags);
}

} // extern "C"
