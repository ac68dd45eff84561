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

} // namespace

JsonBytes::JsonBytes(const std::filesystem::path& file, const JsonRemedies& remedies)
    : file_(file), remedy_(remedies.name), buffer_(piece) {
    require_json_file(file, remedies);
    try {
        opened_ = open_file(std::filesystem::canonical(file), O_RDONLY | O_NONBLOCK);
        size_ = std::filesystem::file_size(file);
    } catch (const std::system_error& error) {
        throw Error(file.string(), fmt::format("cannot be read ({})", error.code().message()),
                    remedy_);
    }
}

std::size_t JsonBytes::read_at(std::uint64_t offset, char* to, std::size_t most) const {
    std::size_t got = 0;
    while (got < most) {
        const ssize_t more =
            ::pread(opened_.number(), to + got, most - got, static_cast<off_t>(offset + got));
        if (more < 0 && errno == EINTR) continue;
        if (more < 0)
            throw Error(file_.string(),
                        fmt::format("cannot be read ({})", std::generic_category().message(errno)),
                        remedy_);
        if (more == 0) break;
        got += static_cast<std::size_t>(more);
    }
    return got;
}

bool JsonBytes::at_end() {
    if (at_ < held_) return false;
    if (before_reading) before_reading();
    before_ += held_;
    at_ = 0;
    held_ = read_at(before_, buffer_.data(), buffer_.size());
    return held_ == 0;
}

std::string JsonBytes::slice(std::uint64_t begin, std::uint64_t end) const {
    std::string text(end - begin, '\0');
    text.resize(read_at(begin, text.data(), text.size()));
    return text;
}

} // namespace shadowproof
