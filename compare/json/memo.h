// Remembers what was made of what, so that the same is made once: techniques that make the same
// volumes have the same pictures and the same lists, and compressing them takes longest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <span>
#include <string>

namespace shadowproof {

/// May be used by several threads at a time.
class Memo {
public:
    using Bytes = std::span<const std::byte>;

    /// What `make` returned earlier for the same inputs, all of them in their order, or returns
    /// now. Inputs are taken for the same if 128 bits of a hash are.
    std::string result(std::initializer_list<Bytes> inputs,
                       const std::function<std::string()>& make);
    /// To be called where little will be the same as before: it frees the memory.
    void forget();

private:
    /// Bytes: little beside what the program takes by itself (scenes/memory_budget.h). What is
    /// beyond is made again.
    static constexpr std::size_t most = std::size_t{3} << 20U;
    static constexpr std::size_t around_each = 128; ///< bytes of a map's node, about

    std::mutex mutex_;
    std::map<std::array<std::uint64_t, 2>, std::string> results_; ///< by hash
    std::size_t size_ = 0;                                        ///< bytes
};

/// The bytes of a text or of a contiguous list of numbers.
template <class List>
Memo::Bytes bytes_for_memo(const List& list) {
    return std::as_bytes(std::span(list));
}

/// The result of `make`, remembered where there is a memo.
std::string remembered(Memo* memo, std::initializer_list<Memo::Bytes> inputs,
                       const std::function<std::string()>& make);

} // namespace shadowproof
