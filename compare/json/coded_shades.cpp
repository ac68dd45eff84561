#include "compare/json/bit_coder.h"
#include "compare/json/coded_lists.h"

#include <algorithm>
#include <cstdlib>

namespace shadowproof {

namespace {

/// What continues the plane through three neighbours, or at an edge the nearer of two (Weinberger,
/// Seroussi, Sapiro, "The LOCO-I lossless image compression algorithm", 2000, section III-A).
std::int32_t continued(std::int32_t west, std::int32_t north, std::int32_t north_west) {
    if (north_west >= std::max(west, north)) return std::min(west, north);
    if (north_west <= std::min(west, north)) return std::max(west, north);
    return west + north - north_west;
}

} // namespace

std::string coded_shades(Numbers values, std::uint32_t width, std::uint32_t channels,
                         Numbers guide) {
    const std::size_t row = std::size_t{width} * channels;
    std::vector<std::int32_t> rest(values.size()); // beyond the guide
    std::vector<std::int32_t> misses(values.size());
    BitCoder coder;
    constexpr std::uint32_t levels = 12; // of how far neighbours were missed
    std::vector<BitChance> is_zero(levels * levels * 4 * channels);
    std::vector<BitChance> is_more(levels * 4 * channels * 8);
    std::vector<BitChance> sign(9 * channels);
    std::vector<NumberCoder> others(channels);
    const auto level = [](std::int32_t sum) {
        const auto bits = static_cast<std::uint32_t>(std::bit_width(static_cast<unsigned>(sum)));
        return sum < 6 ? static_cast<std::uint32_t>(sum) : std::min(levels - 1, 3 + bits);
    };
    const auto sign_of = [](std::int32_t v) { return v < 0 ? 2U : v > 0 ? 1U : 0U; };
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t channel = i % channels;
        const bool has_west = i % row >= channels;
        const bool has_north = i >= row;
        const auto at = [&](const std::vector<std::int32_t>& list, bool there, std::size_t back) {
            return there ? list[i - back] : 0;
        };
        const std::int32_t west = at(rest, has_west, channels);
        const std::int32_t north = at(rest, has_north, row);
        const std::int32_t guess =
            has_north ? continued(west, north, at(rest, has_west, row + channels)) : west;
        rest[i] = static_cast<std::int32_t>(values[i]) -
                  (guide.empty() ? 0 : static_cast<std::int32_t>(guide[i]));
        const std::int32_t missed = rest[i] - guess;
        misses[i] = missed;
        const std::int32_t miss_west = at(misses, has_west, channels);
        const std::int32_t before = channel > 0 ? misses[i - 1] : 0;
        const std::uint32_t around =
            level(std::abs(miss_west) + std::abs(at(misses, has_north, row)) +
                  std::abs(at(misses, has_north && has_west, row + channels)) +
                  std::abs(at(misses, has_north && i % row < row - channels, row - channels)));
        const std::uint32_t beside = std::min<std::uint32_t>(3, std::abs(before));
        const std::uint32_t both = around * levels + level(std::abs(west) + std::abs(north));
        coder.code(missed == 0, is_zero[(both * 4 + beside) * channels + channel]);
        if (missed == 0) continue;
        coder.code(missed < 0,
                   sign[(3 * sign_of(before) + sign_of(miss_west)) * channels + channel]);
        const auto size = static_cast<std::uint32_t>(std::abs(missed));
        BitChance* const more = &is_more[((around * 4 + beside) * channels + channel) * 8];
        for (std::uint32_t k = 1; k <= std::min(size, 8U); ++k) coder.code(size > k, more[k - 1]);
        if (size > 8) others[channel].code(coder, size - 9);
    }
    return coder.finish();
}

} // namespace shadowproof
