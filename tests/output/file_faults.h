// What the two halves of the shim share: which calls count, and which of them fails. See
// file_faults.cpp for the settings.
#pragma once

#include <dlfcn.h>
#include <sys/types.h>

#include <cstddef>

namespace file_faults {

/// The C library's own.
template <class Function>
Function* original(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// Whether an absolute path is that of the folder whose calls are counted, or below it.
bool is_below(const char* path);
/// Whether an open file is.
bool is_below(int descriptor);
/// Whether a path is as a call gets it: relative to a folder that is open, or to the current one.
bool is_below(int folder, const char* path);

/// Counts a call; whether it is the one that fails. errno is set then, and kept otherwise.
bool fails(bool counted);
/// The same of a call that changes nothing, which FAULTS_CHANGES leaves out.
bool fails_to_ask(bool counted);

/// Appends to the log a call on an absolute path, or on an open file.
void record(const char* call, const char* path);
void record(const char* call, int descriptor);

/// How many of `bytes` still fit: fewer, where the budget ends among them.
std::size_t granted(int descriptor, std::size_t bytes);

/// Whether the file system is to have no files without a name, of which `flags` ask for one, or
/// cannot exchange two names. errno is set then.
bool lacks_unnamed(int folder, const char* path, int flags);
bool lacks_exchange(int folder, const char* path, unsigned flags);

} // namespace file_faults
