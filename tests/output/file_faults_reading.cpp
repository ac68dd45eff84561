// Calls that read, and those that ask what is there.
#include "tests/output/file_faults.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

using namespace file_faults;

// The names and types are the C library's.
extern "C" {

ssize_t read(int file, void* to, size_t count) {
    if (fails_to_ask(is_below(file))) return -1;
    return original<ssize_t(int, void*, size_t)>("read")(file, to, count);
}

ssize_t pread(int file, void* to, size_t count, off_t offset) {
    if (fails_to_ask(is_below(file))) return -1;
    return original<ssize_t(int, void*, size_t, off_t)>("pread")(file, to, count, offset);
}

ssize_t pread64(int file, void* to, size_t count, off64_t offset) {
    if (fails_to_ask(is_below(file))) return -1;
    return original<ssize_t(int, void*, size_t, off64_t)>("pread64")(file, to, count, offset);
}

int stat(const char* path, struct stat* to) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, struct stat*)>("stat")(path, to);
}

int stat64(const char* path, struct stat64* to) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, struct stat64*)>("stat64")(path, to);
}

int lstat(const char* path, struct stat* to) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, struct stat*)>("lstat")(path, to);
}

int lstat64(const char* path, struct stat64* to) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, struct stat64*)>("lstat64")(path, to);
}

int fstat(int file, struct stat* to) {
    if (fails_to_ask(is_below(file))) return -1;
    return original<int(int, struct stat*)>("fstat")(file, to);
}

int fstat64(int file, struct stat64* to) {
    if (fails_to_ask(is_below(file))) return -1;
    return original<int(int, struct stat64*)>("fstat64")(file, to);
}

int fstatat(int folder, const char* path, struct stat* to, int flags) {
    if (fails_to_ask(is_below(folder, path))) return -1;
    return original<int(int, const char*, struct stat*, int)>("fstatat")(folder, path, to, flags);
}

int fstatat64(int folder, const char* path, struct stat64* to, int flags) {
    if (fails_to_ask(is_below(folder, path))) return -1;
    return original<int(int, const char*, struct stat64*, int)>("fstatat64")(folder, path, to,
                                                                             flags);
}

int statx(int folder, const char* path, int flags, unsigned mask, struct statx* to) {
    if (fails_to_ask(is_below(folder, path))) return -1;
    return original<int(int, const char*, int, unsigned, struct statx*)>("statx")(folder, path,
                                                                                  flags, mask, to);
}

int access(const char* path, int mode) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return -1;
    return original<int(const char*, int)>("access")(path, mode);
}

ssize_t readlink(const char* path, char* to, size_t size) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return -1;
    return original<ssize_t(const char*, char*, size_t)>("readlink")(path, to, size);
}

char* realpath(const char* path, char* to) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return nullptr;
    return original<char*(const char*, char*)>("realpath")(path, to);
}

DIR* opendir(const char* path) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return nullptr;
    return original<DIR*(const char*)>("opendir")(path);
}

DIR* fdopendir(int file) {
    if (fails_to_ask(is_below(file))) return nullptr;
    return original<DIR*(int)>("fdopendir")(file);
}

dirent* readdir(DIR* folder) {
    if (fails_to_ask(is_below(dirfd(folder)))) return nullptr;
    return original<dirent*(DIR*)>("readdir")(folder);
}

dirent64* readdir64(DIR* folder) {
    if (fails_to_ask(is_below(dirfd(folder)))) return nullptr;
    return original<dirent64*(DIR*)>("readdir64")(folder);
}

FILE* fopen(const char* path, const char* mode) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return nullptr;
    return original<FILE*(const char*, const char*)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
    if (fails_to_ask(is_below(AT_FDCWD, path))) return nullptr;
    return original<FILE*(const char*, const char*)>("fopen64")(path, mode);
}

} // extern "C"
