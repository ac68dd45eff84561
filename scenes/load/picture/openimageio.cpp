#include "scenes/load/picture/openimageio.h"

#include "scenes/error.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#ifndef SHADOWPROOF_BUILT_OPENIMAGEIO
#error "SHADOWPROOF_BUILT_OPENIMAGEIO and SHADOWPROOF_INSTALLED_OPENIMAGEIO: by CMakeLists.txt"
#endif

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// Where it may be: beside the installed program; for programs that link the installed libraries,
/// where their linker was told (the CMake package does); and where it was built.
std::vector<std::string> places() {
    const fs::path installed(SHADOWPROOF_INSTALLED_OPENIMAGEIO);
    std::vector<std::string> files{installed.filename().string(), SHADOWPROOF_BUILT_OPENIMAGEIO};
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    const fs::path beside = program.parent_path().parent_path() / installed;
    if (!failure && fs::exists(beside, failure)) files.insert(files.begin(), beside.string());
    return files;
}

const OpenImageIo* load() {
    std::string why;
    for (const std::string& file : places()) {
        // Never closed: the libraries that come with it have threads.
        void* const handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
        void* const entry = handle == nullptr ? nullptr : dlsym(handle, openimageio_entry);
        if (entry != nullptr) return reinterpret_cast<const OpenImageIo* (*)()>(entry)();
        why += (why.empty() ? "" : "; ") + std::string(dlerror());
    }
    throw Error("OpenImageIO", "cannot be loaded (" + why + ")",
                "install shadowproof and OpenImageIO again, or give more memory");
}

} // namespace

const OpenImageIo& openimageio() {
    static const OpenImageIo& loaded = *load();
    return loaded;
}

} // namespace shadowproof
