#include "compare/json/bit_coder.h"
#include "compare/json/coded_lists.h"

#include <algorithm>
#include <bit>

namespace shadowproof {

namespace {

/// What is known of the numbers of one column. What followed others is in tables by their hash:
/// numbers of one hash spoil each other's guess, which costs little; 0 is nothing.
struct Column {
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
    explicit Column(std::size_t numbers)
        : bits(std::clamp(static_cast<int>(std::bit_width(numbers)), 8, 18)),
          after_two(std::size_t{1} << bits), after_one(std::size_t{1} << bits) {}
};

/// A number behind `two` and `one`; `otherwise` is guessed where `one` is met for the first time.
void code_next(BitCoder& coder, Column& column, std::uint32_t value, std::uint32_t two,
               std::uint32_t one, std::uint32_t otherwise) {
    constexpr std::uint32_t mix = 0x9e3779b1U; // 2^32 over the golden ratio, as Knuth hashes
    const int shift = 32 - column.bits;
    std::uint32_t& after_one = column.after_one[one * mix >> shift];
    std::uint32_t& after_two = column.after_two[(two * mix + one) * mix >> shift];
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

} // namespace

std::string coded_sequence(Numbers values, std::uint32_t columns) {
    BitCoder coder;
    std::vector<Column> all(columns, Column(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        code_next(coder, all[i % columns], values[i], i >= 2 ? values[i - 2] : 0,
                  i >= 1 ? values[i - 1] : 0, i >= columns ? values[i - columns] : 0);
    return coder.finish();
}

std::string coded_rows(Numbers values) {
    BitCoder coder;
    Column column(values.size());
    NumberCoder begins;
    NumberCoder removals;
    NumberCoder additions;
    Numbers before;
    std::int32_t begin_before = 0;
    while (!values.empty()) {
        const auto end = static_cast<std::size_t>(std::ranges::find(values, 0U) - values.begin());
        const Numbers row = values.first(end);
        const std::size_t both = std::min(row.size(), before.size());
        std::size_t begin = 0;
        while (begin < both && row[begin] == before[begin]) ++begin;
        std::size_t tail = 0;
        while (tail < both - begin &&
               row[row.size() - 1 - tail] == before[before.size() - 1 - tail])
            ++tail;
        const auto removed = static_cast<std::int32_t>(before.size() - begin - tail);
        const auto added = static_cast<std::int32_t>(row.size() - begin - tail);
        begins.code(coder, folded(static_cast<std::int32_t>(begin) - begin_before));
        removals.code(coder, static_cast<std::uint32_t>(removed));
        additions.code(coder, folded(added - removed));
        for (std::size_t i = begin; i < row.size() - tail; ++i) {
            const std::uint32_t one = i >= 1 ? row[i - 1] : 0;
            code_next(coder, column, row[i], i >= 2 ? row[i - 2] : 0, one, one);
        }
        begin_before = static_cast<std::int32_t>(begin);
        before = row;
        values = values.subspan(end + 1);
    }
    return coder.finish();
}

} // namespace shadowproof
