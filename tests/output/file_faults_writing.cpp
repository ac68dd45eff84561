// Calls that write, make, rename and remove, and those that open.
#include "tests/output/file_faults.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <optional>

using namespace file_faults;

namespace {

mode_t mode_of(int flags, va_list arguments) {
    const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return has_mode ? va_arg(arguments, mode_t) : 0;
}

/// Counts a call that writes, and charges it to what still fits: how many bytes it may write, or
/// none where it fails.
std::optional<std::size_t> taken_of(int file, std::size_t bytes) {
    record("write", file);
    if (fails(is_below(file))) return std::nullopt;
    const std::size_t taken = granted(file, bytes);
    if (taken > 0 || bytes == 0) return taken;
    errno = ENOSPC;
    return std::nullopt;
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

ssize_t write(int file, const void* from, size_t count) {
    const std::optional<std::size_t> taken = taken_of(file, count);
    if (!taken) return -1;
    return original<ssize_t(int, const void*, size_t)>("write")(file, from, *taken);
}

ssize_t pwrite(int file, const void* from, size_t count, off_t offset) {
    const std::optional<std::size_t> taken = taken_of(file, count);
    if (!taken) return -1;
    return original<ssize_t(int, const void*, size_t, off_t)>("pwrite")(file, from, *taken, offset);
}

ssize_t pwrite64(int file, const void* from, size_t count, off64_t offset) {
    const std::optional<std::size_t> taken = taken_of(file, count);
    if (!taken) return -1;
    return original<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(file, from, *taken,
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
    record("fsync", file);
    if (fails(is_below(file))) return -1;
    return original<int(int)>("fsync")(file);
}

int syncfs(int file) {
    record("syncfs", file);
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
    record("rename", to);
    if (fails(is_below(AT_FDCWD, to))) return -1;
    return original<int(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned int flags) {
    record("renameat2", to);
    if (fails(is_below(to_folder, to))) return -1;
    if (lacks_exchange(to_folder, to, flags)) return -1;
    return original<int(int, const char*, int, const char*, unsigned int)>("renameat2")(
        from_folder, from, to_folder, to, flags);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    record("linkat", to);
    if (fails(is_below(to_folder, to))) return -1;
    return original<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from,
                                                                            to_folder, to, flags);
}

} // extern "C"
