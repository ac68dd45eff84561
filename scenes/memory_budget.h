// How much memory a run may take, and the account of what it holds. Large allocations are requested
// here first: one that fails in the middle of the work would end it without giving a reason and,
// where the kernel overcommits memory, by killing some process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace shadowproof {

/// Bytes that the program takes before it has read anything: its libraries, OpenGL in software with
/// its compiler, the stacks of its threads, and OpenImageIO, which is loaded where a picture needs
/// it. Measured (58 MB for `list`, 160 MB with all techniques, 86 MB more with OpenImageIO), and
/// checked by tests/command/peaks_test.mjs.
inline constexpr std::uint64_t program_bytes = 250'000'000;

/// Bytes that the whole process may take, and where that limit comes from.
struct MemoryBudget {
    static constexpr std::uint64_t no_limit = ~std::uint64_t{0};
    std::uint64_t bytes = no_limit;
    std::string origin = "no limit"; ///< "--memory", or "three quarters of what is available"
};

/// An allocation that is about to be made.
struct MemoryNeed {
    std::uint64_t bytes = 0;
    std::string where;  ///< names the file and the place in it, or the flag
    std::string what;   ///< "its texels"
    std::string remedy; ///< other than more memory
};

/// "4.4 GB", "12 MB"
std::string bytes_in_words(std::uint64_t bytes);

/// Throws Error where `held` bytes and `need` together exceed the budget. It says what is needed,
/// what the budget is and where that comes from.
void require_memory(const MemoryBudget& budget, std::uint64_t held, const MemoryNeed& need);

class MemoryAccount;

/// Bytes of an account, given back on destruction. Must not outlive the account.
class MemoryHold {
public:
    MemoryHold() = default;
    MemoryHold(MemoryAccount& account, std::uint64_t bytes);
    ~MemoryHold();
    MemoryHold(MemoryHold&& other) noexcept;
    MemoryHold& operator=(MemoryHold&& other) noexcept;
    MemoryHold(const MemoryHold&) = delete;
    MemoryHold& operator=(const MemoryHold&) = delete;

private:
    MemoryAccount* account_ = nullptr;
    std::uint64_t bytes_ = 0;
};

/// What one piece of work holds of a budget, the program itself included. For a single thread.
class MemoryAccount {
public:
    explicit MemoryAccount(MemoryBudget budget = {}) : budget_(std::move(budget)) {}
    MemoryAccount(const MemoryAccount&) = delete;
    MemoryAccount& operator=(const MemoryAccount&) = delete;

    /// Each throws Error where the need exceeds what is left. `require` only checks; `hold` takes
    /// the bytes until the hold ends, `keep` until the account does.
    void require(const MemoryNeed& need) const { require_memory(budget_, held_, need); }
    MemoryHold hold(const MemoryNeed& need);
    void keep(const MemoryNeed& need);

    std::uint64_t held() const { return held_; }
    /// The budget of what follows: less what is held beside the program itself.
    MemoryBudget left() const;

private:
    friend class MemoryHold;
    MemoryBudget budget_;
    std::uint64_t held_ = program_bytes;
};

} // namespace shadowproof
