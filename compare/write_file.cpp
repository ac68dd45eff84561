#include "compare/write_file.h"

#include "compare/unfinished.h"
#include "scenes/error.h"

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

/// `file` is what errors name.
void write_to(const fs::path& place, const fs::path& file, const std::string& text) {
    errno = 0;
    std::ofstream stream(place, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw_unwritable(file, errno != 0 ? std::strerror(errno) : "a short write");
}

} // namespace

void write_beside(const fs::path& file, const std::function<void(const fs::path&)>& write) {
    const auto lock = hold_unfinished();
    const Unfinished beside(file);
    write(beside.path());
    std::error_code error;
    fs::rename(beside.path(), file, error);
    if (error) throw_unwritable(file, error.message());
}

void check_writable(const fs::path& file) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw_unwritable(file, "it is a folder");
    const auto lock = hold_unfinished();
    const Unfinished beside(file);
    errno = 0;
    if (!std::ofstream(beside.path(), std::ios::binary))
        throw_unwritable(file, std::strerror(errno));
}

void write_text(const fs::path& file, const std::string& text) {
    write_to(file, file, text);
}

void write_file(const fs::path& file, const std::string& text) {
    write_beside(file, [&](const fs::path& beside) { write_to(beside, file, text); });
}

} // namespace shadowproof
