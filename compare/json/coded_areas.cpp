#include "compare/json/bit_coder.h"
#include "compare/json/coded_lists.h"

#include <algorithm>
#include <array>

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
};

} // namespace

std::string coded_areas(Numbers values, std::uint32_t width, Numbers guide, Numbers mask) {
    const std::size_t pixels = mask.empty() ? values.size() : mask.size();
    Coded coded{width, std::vector<std::uint32_t>(pixels), std::vector<std::uint8_t>(pixels), 0};
    BitCoder coder;
    std::vector<BitChance> chances(6U << 11U);
    NumberCoder steps;
    std::uint32_t largest = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        const auto x = static_cast<std::int64_t>(i % width);
        const auto y = static_cast<std::int64_t>(i / width);
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
        coded.values[i] = value;
        coded.is_coded[i] = 1;
        coded.last = value;
    }
    return coder.finish();
}

} // namespace shadowproof
