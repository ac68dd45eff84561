#include "compare/command/picture_bytes.h"

#include "scenes/error.h"

#include <OpenImageIO/filesystem.h>

#include <memory>
#include <vector>

namespace shadowproof {

std::string picture_bytes(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                          const void* pixels, const std::string& file) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (output && output->supports("ioproxy") && output->set_ioproxy(&memory) &&
        output->open(file, spec) && output->write_image(type, pixels) && output->close())
        return {bytes.begin(), bytes.end()};
    throw Error(file,
                "cannot be written (" + (output ? output->geterror() : OIIO::geterror()) + ")",
                "try a smaller picture");
}

} // namespace shadowproof
