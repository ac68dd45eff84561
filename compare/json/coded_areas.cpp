#include "compare/json/bit_coder.h"
#include "compare/json/coded_lists.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace shadowproof {

namespace {

/// Values by pixel, as far as they are coded; `last` where there is none.
struct Coded {
    std::uint32_t width = 0;
    std::vector<std::uint32_t> values;
    std::vector<std::uint8_t> is_coded;
    std::uint32_t last = 0;

    std::uint32_t at(std::int64_t x, std::int64_t y) const {
        if (x < 0 || y < 0 || x >= width) return last;
        const auto i = static_cast<std::size_t>(y * width + x);
        return is_coded[i] != 0 ? values[i] : last;
    }
    void set(std::size_t first, std::size_t count, std::uint32_t value) {
        const auto offset = static_cast<std::ptrdiff_t>(first);
        std::fill_n(values.begin() + offset, count, value);
        std::fill_n(is_coded.begin() + offset, count, std::uint8_t{1});
        last = value;
    }
};

/// Pixels of a row that are coded by one bit where all around them is of one value.
constexpr std::size_t span_length = 16;
constexpr std::uint32_t chances_of_spans = (5U << 11U) + 1; ///< where they begin among all chances
constexpr std::uint32_t chance_count = 6U << 11U;

bool all_are(std::span<const std::uint32_t> values, std::uint32_t value) {
    return std::ranges::all_of(values, [&](std::uint32_t each) { return each == value; });
}

/// Where the pixels that touch a span and are coded before it have one value, and its guide has one
/// in the span and above it: the number of its chance. `i`: the span's first pixel; `length`:
/// pixels. None in the first row.
std::optional<std::uint32_t> even_span(const Coded& coded, Numbers guide, std::size_t i,
                                       std::size_t length) {
    const std::size_t width = coded.width;
    if (i < width) return std::nullopt;
    const std::size_t x = i % width;
    const std::size_t before = x > 0 ? 1 : 0;
    const std::size_t behind = x + length < width ? 1 : 0;
    const std::span all(coded.values);
    const std::uint32_t value = all[i - width];
    if (before > 0 && all[i - 1] != value) return std::nullopt;
    if (!all_are(all.subspan(i - width - before, before + length + behind), value))
        return std::nullopt;
    if (guide.empty()) return chances_of_spans;
    if (!all_are(guide.subspan(i, length), guide[i]) ||
        !all_are(guide.subspan(i - width, length), guide[i]))
        return std::nullopt;
    return chances_of_spans + (guide[i] == value ? 1U : 2U);
}

/// Codes the span that begins at pixel `i` by one bit, where it may be. Returns how many pixels are
/// coded by it: 0 where they have to be coded singly. `values`: of all pixels.
std::size_t code_even_span(BitCoder& coder, std::vector<BitChance>& chances, Coded& coded,
                           Numbers values, Numbers guide, std::size_t i) {
    const std::size_t length =
        std::min({span_length, coded.width - i % coded.width, values.size() - i});
    const std::optional<std::uint32_t> chance = even_span(coded, guide, i, length);
    if (!chance) return 0;
    const std::uint32_t around = coded.values[i - coded.width];
    const bool even = all_are(values.subspan(i, length), around);
    coder.code(even, chances[*chance]);
    if (!even) return 0;
    coded.set(i, length, around);
    return length;
}

} // namespace

std::string coded_areas(Numbers values, std::uint32_t width, Numbers guide, Numbers mask) {
    const std::size_t pixels = mask.empty() ? values.size() : mask.size();
    Coded coded{width, std::vector<std::uint32_t>(pixels), std::vector<std::uint8_t>(pixels), 0};
    BitCoder coder;
    std::vector<BitChance> chances(chance_count);
    NumberCoder steps;
    std::uint32_t largest = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        const auto x = static_cast<std::int64_t>(i % width);
        const auto y = static_cast<std::int64_t>(i / width);
        if (mask.empty() && i % width % span_length == 0) {
            const std::size_t length = code_even_span(coder, chances, coded, values, guide, i);
            if (length > 0) {
                i += length - 1;
                next += length;
                continue;
            }
        }
        const std::uint32_t value = values[next++];
        const std::uint32_t west = coded.at(x - 1, y);
        const std::uint32_t north = coded.at(x, y - 1);
        const std::uint32_t north_west = coded.at(x - 1, y - 1);
        const std::uint32_t north_east = coded.at(x + 1, y - 1);
        std::uint32_t context = (north == west ? 1U : 0U) | (north_west == west ? 2U : 0U) |
                                (north_west == north ? 4U : 0U) | (north_east == north ? 8U : 0U) |
                                (coded.at(x - 2, y) == west ? 16U : 0U) |
                                (coded.at(x, y - 2) == north ? 32U : 0U);
        std::array<std::uint32_t, 5> guesses{west, north, north_east, north_west, north_west};
        if (!guide.empty()) {
            const std::uint32_t own = guide[i];
            const std::uint32_t guide_west = x > 0 ? guide[i - 1] : own;
            const std::uint32_t guide_north = y > 0 ? guide[i - width] : own;
            context |= (own == guide_west ? 64U : 0U) | (own == guide_north ? 128U : 0U) |
                       (west == guide_west ? 256U : 0U) | (north == guide_north ? 512U : 0U) |
                       1024U;
            guesses = {own, west, north, north_east, north_west};
        }
        bool found = false;
        for (std::size_t k = 0; k < guesses.size() && !found; ++k) {
            if (std::find(guesses.begin(), guesses.begin() + static_cast<std::ptrdiff_t>(k),
                          guesses[k]) != guesses.begin() + static_cast<std::ptrdiff_t>(k))
                continue;
            found = guesses[k] == value;
            coder.code(found, chances[k << 11U | context]);
        }
        if (!found) {
            const bool is_new = value == largest + 1;
            coder.code(is_new, chances[5U << 11U]);
            // Where all are different, values change little by little, as distances do.
            const bool is_slope = west != north && west != north_west && north != north_west;
            const std::uint32_t base = is_slope ? west + north - north_west : west;
            if (!is_new) steps.code(coder, folded(static_cast<std::int32_t>(value - base)));
        }
        largest = std::max(largest, value);
        coded.set(i, 1, value);
    }
    return coder.finish();
}

} // namespace shadowproof
