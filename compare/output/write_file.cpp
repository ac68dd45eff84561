#include "compare/output/write_file.h"

#include "compare/output/descriptor.h"
#include "compare/output/followed.h"
#include "compare/output/passing_file.h"
#include "compare/output/unfinished.h"
#include "compare/output/unwritable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

namespace shadowproof {

namespace fs = std::filesystem;

namespace {

using Status = struct stat;

/// Status of a link's target; none if nothing is there.
std::optional<Status> status_of(const fs::path& file) {
    Status status{};
    if (::stat(file.c_str(), &status) == 0) return status;
    if (errno == ENOENT) return std::nullopt;
    throw_errno();
}

[[noreturn]] void throw_code(int reason) {
    throw std::system_error(reason, std::generic_category());
}

/// Where a file goes: all that is determined before anything is written.
struct Destination {
    std::optional<int> descriptor; ///< an open one of this process
    std::optional<Status> there;   ///< what is there already
    fs::path place;                ///< of a regular file: itself, behind all links
};

Destination destination_of(const fs::path& file) {
    if (!file.has_filename()) throw_code(EISDIR); // "name/"
    Destination to;
    to.descriptor = open_descriptor(file);
    if (to.descriptor) return to;
    to.there = status_of(file);
    if (to.there && S_ISDIR(to.there->st_mode)) throw_code(EISDIR);
    if (!to.there || S_ISREG(to.there->st_mode)) to.place = followed(file);
    return to;
}

bool is_written_into(const Destination& to) {
    return to.descriptor || (to.there && !S_ISREG(to.there->st_mode));
}

/// Waits a while for the reader of a pipe, which may be starting.
Descriptor open_to_write_into(const fs::path& file) {
    using namespace std::chrono_literals;
    constexpr auto pause = 50ms;
    constexpr auto patience = 5s;
    for (auto waited = 0ms;; waited += pause) {
        try {
            return open_file(file, O_WRONLY | O_NOCTTY | O_NONBLOCK);
        } catch (const std::system_error& error) {
            if (error.code().value() != ENXIO || waited >= patience) throw;
        }
        std::this_thread::sleep_for(pause);
    }
}

void write_into(const Destination& to, const fs::path& file, const BytesInParts& bytes) {
    if (to.descriptor) std::fflush(nullptr); // keeps the order with what was printed before
    Descriptor opened = to.descriptor ? Descriptor(::fcntl(*to.descriptor, F_DUPFD_CLOEXEC, 0))
                                      : open_to_write_into(file);
    if (!opened) throw_errno();
    bytes([&](std::string_view part) { write_all(opened, part); });
    sync_to_disk(opened);
    opened.close();
}

/// Keeps owner and mode.
void take_over_mode(const Descriptor& file, const Status& from) {
    // If the owner may not be changed, at least the mode is kept.
    if (::fchown(file.number(), from.st_uid, from.st_gid) != 0 && !may_not_give_away(errno))
        throw_errno();
    if (::fchmod(file.number(), from.st_mode & 07777U) != 0) throw_errno();
}

void put_in_place(const Destination& to, const BytesInParts& bytes) {
    const fs::path folder = to.place.parent_path();
    remove_leftovers(folder, Writers::others);
    PassingFile made = make_passing_file(folder);
    Unfinished unfinished([&made] { discard(made); });
    if (to.there) take_over_mode(made.opened, *to.there);
    bytes([&](std::string_view part) { write_all(made.opened, part); });
    sync_to_disk(made.opened);
    if (to.there || !made.name.empty()) {
        name_in_passing(made, folder);
        if (::rename(made.name.c_str(), to.place.c_str()) != 0) throw_errno();
        unfinished.done();
        made.opened.close();
    } else {
        put_at_place(made, to.place);
        unfinished.done();
    }
    sync_folder(folder);
}

} // namespace

void write_file(const fs::path& file, std::string_view bytes) {
    write_file(file, [&](const TakesBytes& take) { take(bytes); });
}

void write_file(const fs::path& file, const BytesInParts& bytes) {
    const auto lock = hold_unfinished();
    try {
        const Destination to = destination_of(file);
        if (is_written_into(to)) return write_into(to, file, bytes);
        put_in_place(to, bytes);
    } catch (const std::system_error& error) {
        throw unwritable(file, error.code().value());
    }
}

bool is_replaced(const fs::path& file) {
    try {
        return !is_written_into(destination_of(file));
    } catch (const std::system_error& error) {
        throw unwritable(file, error.code().value());
    }
}

void check_writable(const fs::path& file) {
    try {
        const Destination to = destination_of(file);
        if (to.descriptor) {
            const int flags = ::fcntl(*to.descriptor, F_GETFL);
            if (flags < 0) throw_errno();
            if ((flags & O_ACCMODE) == O_RDONLY) throw_code(EBADF);
            return;
        }
        // Not opened: a pipe's reader would see end of file.
        if (to.there && ::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) throw_errno();
        if (is_written_into(to)) return;
        const fs::path folder = to.place.parent_path();
        if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) throw_errno();
        const auto lock = hold_unfinished();
        discard(make_passing_file(folder)); // one without a name goes with its descriptor
        // A name too long for the file system.
        Status ignored{};
        if (::lstat(to.place.c_str(), &ignored) != 0 && errno != ENOENT) throw_errno();
    } catch (const std::system_error& error) {
        throw unwritable(file, error.code().value());
    }
}

void append_to_file(const fs::path& file, std::string_view bytes) {
    try {
        const std::optional<Status> there = status_of(file);
        Descriptor opened = there && S_ISFIFO(there->st_mode)
                                ? open_to_write_into(file)
                                : open_file(file, O_WRONLY | O_APPEND | O_CREAT | O_NOCTTY);
        write_all(opened, bytes);
        opened.close();
    } catch (const std::system_error& error) {
        throw unwritable(file, error.code().value());
    }
}

} // namespace shadowproof
