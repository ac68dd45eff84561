// Codes the numbers of a column, or of rows, each by what followed the same numbers before.
// compare/viewer/coded.js reads them.
#pragma once

#include "compare/json/bit_coder.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowproof {

inline constexpr std::uint32_t hash_mix = 0x9e3779b1U; ///< 2^32 over the golden ratio, as Knuth

/// Of a hash, for a list of so many numbers.
constexpr int hash_bits(std::size_t numbers) {
    return std::clamp(static_cast<int>(std::bit_width(numbers)), 8, 18);
}

/// What is known of the numbers of one column. What followed others is in tables by their hash:
/// numbers of one hash spoil each other's guess, which costs little; 0 is nothing.
struct NumberColumn {
    int bits; ///< of the hash, as many as fit the list
    std::vector<std::uint32_t> after_two;
    std::vector<std::uint32_t> after_one;
    std::vector<BitChance> by_two = std::vector<BitChance>(32);
    std::vector<BitChance> by_one = std::vector<BitChance>(32);
    std::vector<BitChance> is_new = std::vector<BitChance>(32);
    NumberCoder steps;
    std::uint32_t largest = 0;
    std::uint32_t hits =
        0; ///< a bit for each number, the last one lowest: whether by_two was right

    /// `numbers`: how many the list has.
    explicit NumberColumn(std::size_t numbers)
        : bits(hash_bits(numbers)), after_two(std::size_t{1} << bits),
          after_one(std::size_t{1} << bits) {}
};

/// A number behind `two` and `one`; `otherwise` is guessed where `one` is met for the first time.
inline void code_next(BitCoder& coder, NumberColumn& column, std::uint32_t value, std::uint32_t two,
                      std::uint32_t one, std::uint32_t otherwise) {
    const int shift = 32 - column.bits;
    std::uint32_t& after_one = column.after_one[one * hash_mix >> shift];
    std::uint32_t& after_two = column.after_two[(two * hash_mix + one) * hash_mix >> shift];
    if (after_one == 0) after_one = otherwise;
    if (after_two == 0) after_two = after_one;
    const std::uint32_t context = (column.hits & 15U) | (after_two == after_one ? 16U : 0U);
    const bool by_two = after_two == value;
    coder.code(by_two, column.by_two[context]);
    bool found = by_two;
    if (!found && after_one != after_two) {
        found = after_one == value;
        coder.code(found, column.by_one[context]);
    }
    if (!found) {
        found = value == column.largest + 1;
        coder.code(found, column.is_new[context]);
    }
    if (!found) column.steps.code(coder, folded(static_cast<std::int32_t>(value - after_one)));
    column.hits = column.hits << 1U | (by_two ? 1U : 0U);
    column.largest = std::max(column.largest, value);
    after_two = value;
    after_one = value;
}

} // namespace shadowproof
