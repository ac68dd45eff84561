#include "tests/fuzz/private_folder.h"

#include "tests/fuzz/promises.h"

#include <unistd.h>

#include <fstream>

namespace shadowproof::fuzz {

PrivateFolder::PrivateFolder() {
    namespace fs = std::filesystem;
    const fs::path parent =
        fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
    path_ = parent / ("shadowproof-fuzz-" + std::to_string(getpid()));
    fs::create_directories(path_);
}

PrivateFolder::~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path PrivateFolder::write(const std::string& name,
                                           std::span<const std::uint8_t> bytes) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) broken("the fuzzer's own files can be written: " + file.string());
    return file;
}

} // namespace shadowproof::fuzz
