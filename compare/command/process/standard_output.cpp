#include "compare/command/process/standard_output.h"

#include "compare/report/escape.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace shadowproof {

namespace {

bool is_closed(int stream) {
    return fcntl(stream, F_GETFD) < 0 && errno == EBADF;
}

} // namespace

void open_standard_streams() {
    // In this order each gets its own number. Output is opened for reading alone: writing fails.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (is_closed(stream)) [[maybe_unused]]
            const int opened = open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void print(std::string_view text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (std::fflush(stdout) == 0 && written && std::ferror(stdout) == 0) return;
    throw OutputLost(fmt::format("standard output cannot be written ({}); see where it goes",
                                 errno != 0 ? std::strerror(errno) : "an earlier write failed"));
}

void complain(std::string_view message) noexcept {
    try {
        const std::string line = "shadowproof: " + printable(message) + "\n";
        std::fwrite(line.data(), 1, line.size(), stderr);
    } catch (const std::exception&) {
        // No memory to make it printable: printed unchanged.
        std::fwrite(message.data(), 1, message.size(), stderr);
        std::fputc('\n', stderr);
    }
}

} // namespace shadowproof
