#include "scenes/load/picture/openimageio.h"

#include "scenes/load/common/module.h"

#ifndef SHADOWPROOF_BUILT_OPENIMAGEIO
#error "SHADOWPROOF_BUILT_OPENIMAGEIO and SHADOWPROOF_INSTALLED_OPENIMAGEIO: by CMakeLists.txt"
#endif

namespace shadowproof {

const OpenImageIo& openimageio() {
    using Entry = const OpenImageIo* (*)();
    static const OpenImageIo& loaded = *reinterpret_cast<Entry>(module_symbol(
        "OpenImageIO", {SHADOWPROOF_INSTALLED_OPENIMAGEIO, SHADOWPROOF_BUILT_OPENIMAGEIO},
        openimageio_entry))();
    return loaded;
}

} // namespace shadowproof
