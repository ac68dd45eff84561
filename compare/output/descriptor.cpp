#include "compare/output/descriptor.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace shadowproof {

void throw_errno() {
    throw std::system_error(errno, std::generic_category());
}

bool may_not_give_away(int error) {
    return error == EPERM || error == EINVAL || error == ENOSYS || error == EOPNOTSUPP;
}

bool cannot_rename_so(int reason) {
    return reason == EINVAL || reason == ENOSYS || reason == EOPNOTSUPP;
}

Descriptor::~Descriptor() {
    if (number_ >= 0) ::close(number_);
}

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
}

void Descriptor::close() {
    // Linux frees the number whatever it answers (close(2), "Dealing with error returns").
    const int number = std::exchange(number_, -1);
    if (number >= 0 && ::close(number) != 0 && errno != EINTR) throw_errno();
}

Descriptor open_file(const std::filesystem::path& file, int flags, mode_t mode) {
    for (;;) {
        const int number = ::open(file.c_str(), flags | O_CLOEXEC, mode);
        if (number >= 0) return Descriptor(number);
        if (errno != EINTR) throw_errno();
    }
}

void read_pieces(const std::filesystem::path& file,
                 const std::function<void(std::string_view)>& take) {
    constexpr std::size_t piece_bytes = std::size_t{1} << 18U;
    const Descriptor opened = open_file(file, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    struct stat status {};
    if (::fstat(opened.number(), &status) != 0) throw_errno();
    if (!S_ISREG(status.st_mode)) throw std::system_error(EINVAL, std::generic_category());
    std::vector<char> piece(piece_bytes);
    for (;;) {
        const ssize_t got = ::read(opened.number(), piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw_errno();
        if (got == 0) return;
        take(std::string_view(piece.data(), static_cast<std::size_t>(got)));
    }
}

namespace {

/// Waits for the reader of a full pipe, but not for ever.
void wait_for_reader(const Descriptor& pipe) {
    constexpr int patience_milliseconds = 5000;
    pollfd waiting{.fd = pipe.number(), .events = POLLOUT, .revents = 0};
    const int ready = ::poll(&waiting, 1, patience_milliseconds);
    if (ready == 0) errno = ETIMEDOUT;
    if (ready == 0 || (ready < 0 && errno != EINTR)) throw_errno();
}

} // namespace

void write_all(const Descriptor& to, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(to.number(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0 && errno == EAGAIN) {
            wait_for_reader(to);
            continue;
        }
        if (written == 0) errno = EIO; // nothing written and no reason given: it would never end
        if (written <= 0) throw_errno();
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void sync_to_disk(const Descriptor& file) {
    while (::fsync(file.number()) != 0) {
        if (errno == EINVAL || errno == EROFS || errno == ENOTSUP) return;
        if (errno != EINTR) throw_errno();
    }
}

void sync_folder(const std::filesystem::path& folder) {
    sync_to_disk(open_file(folder, O_RDONLY | O_DIRECTORY));
}

} // namespace shadowproof
