// Open files, and the system calls on them that may fail. Each is checked, repeated if a signal
// interrupts it, and throws std::system_error with the kernel's reason. Callers add the name that
// the user gave (compare/output/unwritable.h).
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string_view>

namespace shadowproof {

/// Throws std::system_error of errno.
[[noreturn]] void throw_errno();

/// Whether an error of chown says that this process may not give the file to that owner, or that a
/// user namespace or a file system knows no such owner.
bool may_not_give_away(int error);

/// Whether an error of renameat2 says that the file system knows no such way of renaming.
bool cannot_rename_so(int reason);

/// An open file, closed on destruction.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }
    explicit operator bool() const { return number_ >= 0; }
    /// Closes it now, and throws if the file system reports an error.
    void close();

private:
    int number_ = -1;
};

/// open(2), closed on exec. `mode`: of a file that is created, before the umask.
Descriptor open_file(const std::filesystem::path& file, int flags, mode_t mode = 0666);

/// Calls `take` with all bytes of a regular file, piece by piece. Links are not followed. Anything
/// but a regular file is EINVAL, and is not waited for.
void read_pieces(const std::filesystem::path& file,
                 const std::function<void(std::string_view)>& take);

/// Writes all bytes, in as many calls as that takes.
void write_all(const Descriptor& to, std::string_view bytes);

/// fsync(2); what cannot be synced (a pipe, a device) needs no sync.
void sync_to_disk(const Descriptor& file);
/// The same for the names in a folder.
void sync_folder(const std::filesystem::path& folder);

} // namespace shadowproof
