// Work in a process of its own, for libraries that damaged input may bring to crash, to allocate
// without bound or to run for ever. Such an end is a value here; this process is not affected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace shadowproof {

/// Bytes, zero at first, that this process shares with those that it starts.
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

/// What a process may take beyond what this one holds when it is started.
struct ApartLimits {
    std::uint64_t bytes = 0;   ///< of addresses; no limit under AddressSanitizer
    std::uint64_t seconds = 1; ///< of processor time; one that only waits is ended, too, much later
};

enum class ApartEnd : std::uint8_t {
    finished,
    no_process,    ///< none could be started
    out_of_memory, ///< an allocation failed
    threw,         ///< another exception
    out_of_time,
    crashed, ///< ended by a signal
};

/// Runs `work` in a child process, which is gone when this returns; it prints nothing, and ends
/// with this process. All that it leaves behind are the SharedBytes that it wrote. Needs: other
/// threads hold no lock that `work` takes (glibc frees its allocator's in the child).
ApartEnd run_apart(const ApartLimits& limits, const std::function<void()>& work);

} // namespace shadowproof
