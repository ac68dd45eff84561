#include "scenes/load/common/module.h"

#include "scenes/error.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// Where it may be: beside the installed program; for programs that link the installed libraries,
/// where their linker was told (the CMake package does); and where it was built.
std::vector<std::string> files_of(const ModulePlaces& places) {
    const fs::path installed(places.installed);
    std::vector<std::string> files{installed.filename().string(), places.built};
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    const fs::path beside = program.parent_path().parent_path() / installed;
    if (!failure && fs::exists(beside, failure)) files.insert(files.begin(), beside.string());
    return files;
}

} // namespace

void* module_symbol(const std::string& what, const ModulePlaces& places, const char* symbol) {
    std::string why;
    for (const std::string& file : files_of(places)) {
        // Never closed: the libraries that come with it may have threads.
        void* const handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
        void* const found = handle == nullptr ? nullptr : dlsym(handle, symbol);
        if (found != nullptr) return found;
        why += (why.empty() ? "" : "; ") + std::string(dlerror());
    }
    throw Error(what, "cannot be loaded (" + why + ")",
                "install shadowproof and " + what + " again, or give more memory");
}

} // namespace shadowproof
