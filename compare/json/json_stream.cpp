#include "compare/json/json_stream.h"

#include "scenes/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace shadowproof {

namespace {

constexpr std::size_t piece = std::size_t{1} << 16U; // bytes read at once

Error unreadable(const std::filesystem::path& file, const std::error_code& why,
                 const JsonRemedies& remedies) {
    return {file.string(), fmt::format("cannot be read ({})", why.message()), remedies.name};
}

Descriptor opened(const std::filesystem::path& file, const JsonRemedies& remedies) {
    require_json_file(file, remedies);
    try {
        return open_file(std::filesystem::canonical(file), O_RDONLY | O_NONBLOCK);
    } catch (const std::system_error& error) {
        throw unreadable(file, error.code(), remedies);
    }
}

/// As many bytes as there are, up to `most`. Throws std::system_error.
std::size_t read_at(const Descriptor& file, std::uint64_t offset, char* to, std::size_t most) {
    std::size_t got = 0;
    while (got < most) {
        const ssize_t more =
            ::pread(file.number(), to + got, most - got, static_cast<off_t>(offset + got));
        if (more < 0 && errno == EINTR) continue;
        if (more < 0) throw_errno();
        if (more == 0) break;
        got += static_cast<std::size_t>(more);
    }
    return got;
}

} // namespace

JsonBytes::JsonBytes(const std::filesystem::path& file, const JsonRemedies& remedies)
    : file_(file), remedies_(remedies), opened_(opened(file, remedies)), buffer_(piece) {
    std::error_code ignored;
    size_ = std::filesystem::file_size(file, ignored);
}

bool JsonBytes::at_end() {
    if (at_ < held_) return false;
    if (before_reading) before_reading();
    before_ += held_;
    at_ = 0;
    try {
        held_ = read_at(opened_, before_, buffer_.data(), buffer_.size());
    } catch (const std::system_error& error) {
        throw unreadable(file_, error.code(), remedies_);
    }
    return held_ == 0;
}

std::string json_slice(const std::filesystem::path& file, std::uint64_t begin, std::uint64_t end,
                       const JsonRemedies& remedies) {
    std::string text(end - begin, '\0');
    try {
        text.resize(read_at(opened(file, remedies), begin, text.data(), text.size()));
    } catch (const std::system_error& error) {
        throw unreadable(file, error.code(), remedies);
    }
    return text;
}

} // namespace shadowproof
