#include "compare/command/pieces/messages.h"

#include "scenes/error.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace shadowproof {

namespace {

/// Each message is preceded by the number of its bytes.
using Length = std::uint64_t;

void write_whole(int pipe, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t written = write(pipe, bytes.data() + at, bytes.size() - at);
        if (written < 0 && errno != EINTR)
            throw Error("shadowproof", "the process that watches over this one is gone",
                        "run it again");
        if (written > 0) at += static_cast<std::size_t>(written);
    }
}

} // namespace

void send(int pipe, const Message& message) {
    const std::string body = packed(message);
    const Length length = body.size();
    std::string bytes(sizeof length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    write_whole(pipe, bytes + body);
}

bool MessageReader::holds_message() const {
    Length length = 0;
    if (bytes_.size() < sizeof length) return false;
    std::memcpy(&length, bytes_.data(), sizeof length);
    return bytes_.size() - sizeof length >= length;
}

void MessageReader::read_some(int milliseconds) {
    pollfd waiting{.fd = pipe_, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return;
    constexpr std::size_t most = std::size_t{1} << 16;
    const std::size_t held = bytes_.size();
    bytes_.resize(held + most);
    const ssize_t got = read(pipe_, bytes_.data() + held, most);
    bytes_.resize(held + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    ended_ = got == 0 || (got < 0 && errno != EINTR);
}

std::optional<Message> MessageReader::next(int milliseconds) {
    if (!holds_message() && !ended_) read_some(milliseconds);
    if (!holds_message()) return std::nullopt;
    Length length = 0;
    std::memcpy(&length, bytes_.data(), sizeof length);
    const auto message = unpacked<Message>(bytes_.substr(sizeof length, length));
    bytes_.erase(0, sizeof length + length);
    return message;
}

} // namespace shadowproof
