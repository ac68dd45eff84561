// A folder of this process alone: what a file names is looked for there, and is not there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace shadowproof::fuzz {

class PrivateFolder {
public:
    /// In memory where /dev/shm is.
    PrivateFolder();
    ~PrivateFolder();
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;

    std::filesystem::path write(const std::string& name, std::span<const std::uint8_t> bytes) const;

private:
    std::filesystem::path path_;
};

} // namespace shadowproof::fuzz
