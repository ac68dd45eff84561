#include "compare/bench/growth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

TEST(ExponentOf, finds_the_exponent_of_a_power_law) {
    for (const double p : {0.0, 0.5, 1.0, 2.0}) {
        std::vector<GrowthPoint> points;
        for (const double size : {1e3, 1e4, 1e5, 1e6})
            points.push_back({size, {3 * std::pow(size, p)}});
        const auto exponent = exponent_of(points);
        ASSERT_TRUE(exponent);
        EXPECT_NEAR(exponent->value, p, 1e-12);
        EXPECT_NEAR(exponent->low, p, 1e-6);
        EXPECT_NEAR(exponent->high, p, 1e-6);
        EXPECT_FALSE(break_of(points)) << "too few sizes on each side";
    }
}

TEST(ExponentOf, has_the_interval_that_is_known_by_hand) {
    // ln ms = 0, 2, 1 at ln size = -1, 0, 1: slope 0.5, residual 1.5, so that half the interval is
    // t(1) sqrt(1.5 / 1 / 2) = 12.706 * 0.866025.
    const auto exponent =
        exponent_of({{std::exp(-1), {1}}, {1, {std::exp(2)}}, {std::exp(1), {std::exp(1)}}});
    ASSERT_TRUE(exponent);
    EXPECT_NEAR(exponent->value, 0.5, 1e-12);
    EXPECT_NEAR(exponent->high, 0.5 + 12.706 * std::sqrt(0.75), 1e-9);
    EXPECT_NEAR(exponent->low, 0.5 - 12.706 * std::sqrt(0.75), 1e-9);
}

TEST(ExponentOf, has_none_of_two_sizes_nor_of_one_size_alone) {
    EXPECT_FALSE(exponent_of({{1, {1}}, {2, {2}}}));
    EXPECT_FALSE(exponent_of({{2, {1}}, {2, {2}}, {2, {3}}}));
    EXPECT_FALSE(exponent_of({{1, {0}}, {2, {2}}, {3, {3}}})) << "no time has no logarithm";
}

TEST(BreakOf, names_the_size_where_another_law_begins) {
    std::vector<GrowthPoint> points;
    // Flat up to 1e4, then linear.
    for (const double size : {1e2, 1e3, 1e4, 1e5, 1e6})
        points.push_back({size, {std::max(1.0, size / 1e4)}});
    const auto found = break_of(points);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->size, 1e4);
    EXPECT_NEAR(found->below.value, 0, 1e-9);
    EXPECT_NEAR(found->above.value, 1, 1e-9);
}

TEST(BreakOf, is_not_seen_in_noise) {
    std::vector<GrowthPoint> points;
    double noise = 1.1;
    for (const double size : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
        points.push_back({size, {size * noise}});
        noise = 1 / noise;
    }
    EXPECT_FALSE(break_of(points));
}

} // namespace
} // namespace shadowproof
