#include "scenes/texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace shadowproof {
namespace {

/// The texel that OpenGL 4.5's table 8.20 takes for any texel number.
int wrapped(Wrap wrap, int texel, int n) {
    const auto modulo = [](int value, int period) { return (value % period + period) % period; };
    if (wrap == Wrap::clamp_to_edge) return texel < 0 ? 0 : (texel >= n ? n - 1 : texel);
    if (wrap == Wrap::repeat) return modulo(texel, n);
    const int a = modulo(texel, 2 * n) - n;
    return n - 1 - (a >= 0 ? a : -(1 + a));
}

TEST(taps, are_those_of_opengls_table_of_wrap_modes) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const int n : {1, 2, 3, 8})
            for (int k = -97; k <= 97; ++k) {
                const double at = k / 16.0; // exact, and so is all below but for n = 3
                const double x = n * at - 0.5;
                const int below = static_cast<int>(std::floor(x));
                const Taps taps = taps_at(wrap, n, at);
                // A sum over the two texels is all that counts: where they are one, or the
                // fraction is a rounding away from 0 or 1, several answers are the same.
                std::array<double, 8> expected{};
                std::array<double, 8> found{};
                expected[static_cast<std::size_t>(wrapped(wrap, below, n))] += 1 - (x - below);
                expected[static_cast<std::size_t>(wrapped(wrap, below + 1, n))] += x - below;
                ASSERT_TRUE(taps.first >= 0 && taps.first < n && taps.second >= 0 &&
                            taps.second < n);
                found[static_cast<std::size_t>(taps.first)] += 1 - taps.fraction;
                found[static_cast<std::size_t>(taps.second)] += taps.fraction;
                for (std::size_t i = 0; i < 8; ++i)
                    ASSERT_NEAR(found[i], expected[i], 1e-14) // a few roundings of numbers below 64
                        << "at " << at << " of " << n;
            }
}

TEST(taps, stay_within_the_texture_at_any_coordinate) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const int n : {1, 2, 3, 4096})
            for (const double size : {1e-320, 1e-20, 0.999999999999, 1e9, 3e9, 1e18, 1e38, 1e300})
                for (const double at : {size, -size, 1 - size, 1 + size}) {
                    const Taps taps = taps_at(wrap, n, at);
                    EXPECT_TRUE(taps.first >= 0 && taps.first < n) << at;
                    EXPECT_TRUE(taps.second >= 0 && taps.second < n) << at;
                    EXPECT_TRUE(taps.fraction >= 0 && taps.fraction < 1) << at;
                }
}

TEST(sampling, gives_a_texel_at_its_centre_and_the_mean_of_four_between_them) {
    Image<double> texels(4, 2);
    texels.pixels = {1, 2, 4, 8, 16, 32, 64, 128};
    const auto at = [&](double u, double v) {
        return sample<double>(texels, taps_at(Wrap::clamp_to_edge, 4, u),
                              taps_at(Wrap::clamp_to_edge, 2, v));
    };
    EXPECT_EQ(at(0.375, 0.25), 2);
    EXPECT_EQ(at(0.875, 0.75), 128);
    EXPECT_EQ(at(0.5, 0.5), (2 + 4 + 32 + 64) / 4.0);
    EXPECT_EQ(at(-3, 7), 16); // the lower left texel
}

TEST(sampling, leaves_equal_texels_as_they_are_at_any_coordinate) {
    const Image<float> texels(5, 7, 0.1F);
    for (int k = 0; k < 1000; ++k)
        EXPECT_EQ(sample<double>(texels, taps_at(Wrap::repeat, 5, k * 0.0137),
                                 taps_at(Wrap::mirrored_repeat, 7, k * 0.0731)),
                  static_cast<double>(0.1F));
}

} // namespace
} // namespace shadowproof
