#include "compare/write_file.h"

#include "compare/report.h"
#include "scenes/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace shadowproof {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void throw_unwritable(const fs::path& file, const std::string& reason) {
    throw Error(file.string(), "cannot be written (" + reason + ")",
                "name a file in a folder that exists and is writable");
}

} // namespace

void write_beside(const fs::path& file, const std::function<void(const fs::path&)>& write) {
    const fs::path beside = fmt::format("{}.writing-{}", file.string(), getpid());
    std::error_code error;
    try {
        write(beside);
    } catch (...) {
        fs::remove(beside, error);
        throw;
    }
    fs::rename(beside, file, error);
    if (!error) return;
    const std::string reason = error.message();
    fs::remove(beside, error);
    throw_unwritable(file, reason);
}

void write_file(const fs::path& file, const std::string& text) {
    write_beside(file, [&](const fs::path& beside) {
        errno = 0;
        std::ofstream stream(beside, std::ios::binary);
        stream << text;
        stream.close();
        if (!stream) throw_unwritable(file, errno != 0 ? std::strerror(errno) : "a short write");
    });
}

} // namespace shadowproof
