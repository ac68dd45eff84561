// Runs work in a child process, for libraries that may crash, allocate without bound or run for
// ever on damaged input. How the child ended is a return value; this process is not affected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace shadowproof {

/// Bytes, initially zero, that this process shares with its child processes.
class SharedBytes {
public:
    /// Throws std::bad_alloc.
    explicit SharedBytes(std::size_t size);
    ~SharedBytes();
    SharedBytes(const SharedBytes&) = delete;
    SharedBytes& operator=(const SharedBytes&) = delete;
    std::span<unsigned char> bytes() const { return {first_, size_}; }

private:
    unsigned char* first_ = nullptr;
    std::size_t size_ = 0;
};

/// Limits of the child process, beyond what this process holds when it starts the child.
struct IsolationLimits {
    std::uint64_t bytes = 0;   ///< of addresses; no limit under AddressSanitizer
    std::uint64_t seconds = 1; ///< of processor time; one that only waits ends later
};

enum class IsolatedEnd : std::uint8_t {
    finished,
    no_process,    ///< none could be started
    out_of_memory, ///< an allocation failed
    threw,         ///< another exception
    out_of_time,
    crashed, ///< ended by a signal
};

/// Runs `work` in a child process, which is gone when this returns; it prints nothing, and ends
/// with this process. Its only result is what it wrote to SharedBytes. Other threads must hold no
/// lock that `work` takes (glibc releases its allocator's in the child).
IsolatedEnd run_isolated(const IsolationLimits& limits, const std::function<void()>& work);

} // namespace shadowproof
