#include "scenes/surface/alpha_mask.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof {
namespace {

TEST(AlphaMask, is_read_at_the_texels_that_taps_at_finds) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (int texels = 1; texels < 6; ++texels)
            for (int step = -60; step < 60; ++step) {
                const double at = step / 16.0;
                const Taps taps = taps_at(wrap, texels, at);
                const double place = texels * at - 0.5;
                const auto first = static_cast<std::int64_t>(std::floor(place));
                const int second = wrapped(wrap, texels, first + 1);
                // Beyond a border that is clamped to, both are the border's.
                if (wrap != Wrap::clamp_to_edge || (place >= 0 && place < texels - 1)) {
                    EXPECT_EQ(wrapped(wrap, texels, first), taps.first) << at;
                    EXPECT_EQ(second, taps.second) << at;
                } else {
                    EXPECT_EQ(wrapped(wrap, texels, first),
                              taps.fraction == 0 ? taps.first : second);
                }
            }
}

TEST(AlphaMask, range_holds_what_is_there_and_is_reached) {
    Dice dice(1);
    constexpr std::array wraps{Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
    for (int round = 0; round < 300; ++round) {
        AlphaMask mask{.name = "mask",
                       .alpha = Image<float>(static_cast<int>(1 + dice.below(5)),
                                             static_cast<int>(1 + dice.below(5))),
                       .wrap_s = wraps[dice.below(3)],
                       .wrap_t = wraps[dice.below(3)]};
        for (float& alpha : mask.alpha.pixels) alpha = static_cast<float>(dice.below(256)) / 255.0F;
        const glm::dvec2 low(dice.between(-2, 2), dice.between(-2, 2));
        const glm::dvec2 high = low + glm::dvec2(dice.between(0, 0.7), dice.between(0, 0.7));
        const AlphaRange range = alpha_range(mask, low, high);
        double least = 1;
        double most = 0;
        constexpr int steps = 40;
        for (int y = 0; y <= steps; ++y)
            for (int x = 0; x <= steps; ++x) {
                const glm::dvec2 at = low + (high - low) * glm::dvec2(x, y) / double{steps};
                const auto alpha =
                    sample<double>(mask.alpha, taps_at(mask.wrap_s, mask.alpha.width, at.x),
                                   taps_at(mask.wrap_t, mask.alpha.height, at.y));
                least = std::min(least, alpha);
                most = std::max(most, alpha);
            }
        EXPECT_LE(range.low, least);
        EXPECT_GE(range.high, most);
        // Between samples alpha changes by no more than their distance in texels.
        const double loose = 0.7 * (mask.alpha.width + mask.alpha.height) / steps;
        EXPECT_GE(range.low, least - loose);
        EXPECT_LE(range.high, most + loose);
    }
}

TEST(AlphaMask, range_is_all_there_may_be_where_no_number_tells) {
    const AlphaMask mask{.name = "mask", .alpha = Image<float>(2, 2, 0.25F)};
    const AlphaRange range = alpha_range(mask, glm::dvec2(0), glm::dvec2(NAN));
    EXPECT_EQ(range.low, 0);
    EXPECT_EQ(range.high, 1);
}

} // namespace
} // namespace shadowproof
