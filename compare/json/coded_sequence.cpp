#include "compare/json/bit_coder.h"
#include "compare/json/coded_lists.h"

#include <algorithm>
#include <unordered_map>

namespace shadowproof {

namespace {

/// What is known of one column of the rows.
struct Column {
    std::unordered_map<std::uint64_t, std::uint32_t> after_two; ///< by both numbers
    std::unordered_map<std::uint32_t, std::uint32_t> after_one;
    std::vector<Chance> by_two = std::vector<Chance>(32);
    std::vector<Chance> by_one = std::vector<Chance>(32);
    std::vector<Chance> is_new = std::vector<Chance>(32);
    NumberCoder steps;
    std::uint32_t largest = 0;
    std::uint32_t hits =
        0; ///< a bit for each number, the last one lowest: whether by_two was right
};

} // namespace

std::string coded_sequence(Numbers values, std::uint32_t columns) {
    BitCoder coder;
    std::vector<Column> all(columns);
    for (std::size_t i = 0; i < values.size(); ++i) {
        Column& column = all[i % columns];
        const std::uint32_t value = values[i];
        const std::uint32_t one = i >= 1 ? values[i - 1] : 0;
        const std::uint32_t two = i >= 2 ? values[i - 2] : 0;
        const std::uint32_t row_before = i >= columns ? values[i - columns] : 0;
        std::uint32_t& after_one = column.after_one.try_emplace(one, row_before).first->second;
        std::uint32_t& after_two =
            column.after_two.try_emplace(std::uint64_t{two} << 32U | one, after_one).first->second;
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
    return coder.finish();
}

} // namespace shadowproof
