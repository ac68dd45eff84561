// A folder of one test, and the files in it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace shadowproof::test {

/// Gone with its test. `name`: of the test file.
struct ScratchFolder {
    std::filesystem::path path;

    explicit ScratchFolder(const std::string& name)
        : path(std::filesystem::temp_directory_path() /
               ("shadowproof-" + name + "-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~ScratchFolder() { std::filesystem::remove_all(path); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
};

/// All bytes of a file; none where it cannot be read.
inline std::string text_in(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Replaces what a file holds.
inline void put_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

} // namespace shadowproof::test
