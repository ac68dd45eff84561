#include "scenes/load/openimageio/openimageio.h"

#include "scenes/error.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#ifndef SHADOWPROOF_BUILT_OPENIMAGEIO
#error "SHADOWPROOF_BUILT_OPENIMAGEIO and SHADOWPROOF_INSTALLED_OPENIMAGEIO: by CMakeLists.txt"
#endif

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// Beside the installed program, in the folder where it was built, or, for programs that link the
/// installed libraries, where the linker was told (the CMake package does).
std::string library() {
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    const fs::path installed(SHADOWPROOF_INSTALLED_OPENIMAGEIO);
    for (const fs::path& file :
         {program.parent_path().parent_path() / installed, fs::path(SHADOWPROOF_BUILT_OPENIMAGEIO)})
        if (fs::exists(file, failure)) return file.string();
    return installed.filename().string();
}

const OpenImageIo* load() {
    const std::string name = library();
    // Never closed: the libraries that come with it have threads.
    void* const handle = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* const entry = handle == nullptr ? nullptr : dlsym(handle, openimageio_entry);
    if (entry == nullptr)
        throw Error(name, std::string("cannot be loaded (") + dlerror() + ")",
                    "install shadowproof and OpenImageIO again");
    return reinterpret_cast<const OpenImageIo* (*)()>(entry)();
}

} // namespace

const OpenImageIo& openimageio() {
    static const OpenImageIo& loaded = *load();
    return loaded;
}

} // namespace shadowproof
