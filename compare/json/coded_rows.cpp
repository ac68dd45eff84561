#include "compare/json/bit_coder.h"
#include "compare/json/coded_lists.h"
#include "compare/json/number_column.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

/// Numbers `begin` to `end` of the row before that those `row_begin` to `row_end` stand for.
struct Edit {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t row_begin = 0;
    std::size_t row_end = 0;
};

/// The longest list of positions in `before`, rising, and in `row` where the same number is: by
/// patience sorting, as a row has each number once (Schensted, "Longest increasing and decreasing
/// subsequences", 1961). A number that a row has twice counts where it is last.
std::vector<std::pair<std::size_t, std::size_t>> common_numbers(Numbers before, Numbers row) {
    std::vector<std::pair<std::uint32_t, std::size_t>> places; // of the numbers of `before`
    for (std::size_t i = before.size(); i-- > 0;) places.emplace_back(before[i], i);
    std::ranges::stable_sort(places, {}, &std::pair<std::uint32_t, std::size_t>::first);
    constexpr std::size_t none = ~std::size_t{0};
    struct Node {
        std::size_t in_before;
        std::size_t in_row;
        std::size_t previous;
    };
    std::vector<Node> nodes;
    std::vector<std::size_t> tops; // the node that ends the list of each length lowest
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto found = std::ranges::lower_bound(places, row[i], {},
                                                    &std::pair<std::uint32_t, std::size_t>::first);
        if (found == places.end() || found->first != row[i]) continue;
        const auto top = std::ranges::lower_bound(
            tops, found->second, {}, [&](std::size_t node) { return nodes[node].in_before; });
        nodes.push_back({found->second, i, top == tops.begin() ? none : *(top - 1)});
        if (top == tops.end())
            tops.push_back(nodes.size() - 1);
        else
            *top = nodes.size() - 1;
    }
    std::vector<std::pair<std::size_t, std::size_t>> common;
    for (std::size_t node = tops.empty() ? none : tops.back(); node != none;
         node = nodes[node].previous)
        common.emplace_back(nodes[node].in_before, nodes[node].in_row);
    std::ranges::reverse(common);
    return common;
}

/// What makes `row` of `before`, from their begin on.
std::vector<Edit> edits_between(Numbers before, Numbers row) {
    const auto differ = std::ranges::mismatch(before, row);
    const auto begin = static_cast<std::size_t>(differ.in1 - before.begin());
    const std::size_t both = std::min(before.size(), row.size()) - begin;
    std::size_t tail = 0;
    while (tail < both && before[before.size() - 1 - tail] == row[row.size() - 1 - tail]) ++tail;
    auto common = common_numbers(before.subspan(begin, before.size() - begin - tail),
                                 row.subspan(begin, row.size() - begin - tail));
    common.emplace_back(before.size() - begin - tail, row.size() - begin - tail); // their end
    std::vector<Edit> edits;
    std::size_t in_before = begin;
    std::size_t in_row = begin;
    for (auto [next_before, next_row] : common) {
        next_before += begin;
        next_row += begin;
        if (next_before > in_before || next_row > in_row)
            edits.push_back({in_before, next_before, in_row, next_row});
        in_before = next_before + 1;
        in_row = next_row + 1;
    }
    return edits;
}

/// The numbers that stood for others last, the last first.
class Replacements {
public:
    static constexpr std::size_t remembered_each = 4;

    /// `numbers`: how many the list has.
    explicit Replacements(std::size_t numbers)
        : shift_(32 - hash_bits(numbers)), of_hash_(std::size_t{1} << hash_bits(numbers)) {}

    /// `kind`: 0 to 3, of what `number` is to `value`. Whether that was coded.
    bool code(BitCoder& coder, std::uint32_t number, std::uint32_t kind, std::uint32_t value) {
        auto& last = of_hash_[(4 * number + kind) * hash_mix >> shift_];
        for (std::size_t i = 0; i < remembered_each && last[i] != 0; ++i) {
            const bool found = last[i] == value;
            coder.code(found, chances_[remembered_each * kind + i]);
            if (!found) continue;
            std::rotate(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(i),
                        last.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            return true;
        }
        std::rotate(last.begin(), last.end() - 1, last.end());
        last[0] = value;
        return false;
    }

private:
    int shift_;
    std::vector<std::array<std::uint32_t, remembered_each>> of_hash_;
    std::vector<BitChance> chances_ = std::vector<BitChance>(4 * remembered_each);
};

} // namespace

std::string coded_rows(Numbers values) {
    BitCoder coder;
    NumberColumn column(values.size());
    Replacements replacements(values.size());
    NumberCoder counts;
    NumberCoder gaps;
    NumberCoder removals;
    std::vector<NumberCoder> additions(8); // by how many were removed
    Numbers before;
    while (!values.empty()) {
        const auto end = static_cast<std::size_t>(std::ranges::find(values, 0U) - values.begin());
        const Numbers row = values.first(end);
        const std::vector<Edit> edits = edits_between(before, row);
        counts.code(coder, static_cast<std::uint32_t>(edits.size()));
        std::size_t at = 0; // in the row before
        for (const Edit& edit : edits) {
            const std::size_t removed = edit.end - edit.begin;
            const std::size_t added = edit.row_end - edit.row_begin;
            gaps.code(coder, static_cast<std::uint32_t>(edit.begin - at));
            removals.code(coder, static_cast<std::uint32_t>(removed));
            additions[std::min<std::size_t>(removed, 7)].code(coder,
                                                              static_cast<std::uint32_t>(added));
            for (std::size_t k = 0; k < added; ++k) {
                const std::size_t i = edit.row_begin + k;
                const std::uint32_t one = i >= 1 ? row[i - 1] : 0;
                // In the place of a number, before one, or behind one.
                const bool replaces = k < removed;
                const bool inserts = removed == 0 && k == 0 && edit.begin < before.size();
                const std::uint32_t kind = replaces ? (k == 0 ? 0 : 1) : inserts ? 2 : 3;
                const std::uint32_t number = replaces || inserts ? before[edit.begin + k] : one;
                if (!replacements.code(coder, number, kind, row[i]))
                    code_next(coder, column, row[i], i >= 2 ? row[i - 2] : 0, one, one);
            }
            at = edit.end;
        }
        before = row;
        values = values.subspan(end + 1);
    }
    return coder.finish();
}

} // namespace shadowproof
