#include "compare/bench/interval.h"

#include <gtest/gtest.h>

#include <numeric>

namespace shadowproof {
namespace {

/// 1, 2, ... n milliseconds.
std::vector<double> counted_up(std::size_t n) {
    std::vector<double> samples(n);
    std::iota(samples.begin(), samples.end(), 1.0);
    return samples;
}

TEST(MedianInterval, has_the_ranks_of_the_sign_test) {
    // Conover 1999, table A3: the largest r with P(B < r) <= 2.5 %, B binomial with p = 1/2.
    const std::vector<std::pair<std::size_t, double>> ranks{
        {6, 1}, {8, 1}, {9, 2}, {11, 2}, {12, 3}, {15, 4}, {20, 6}, {25, 8}, {30, 10}, {50, 18}};
    for (const auto& [n, rank] : ranks) {
        const TimeInterval interval = median_interval(counted_up(n));
        EXPECT_EQ(interval.low, rank) << n;
        EXPECT_EQ(interval.high, static_cast<double>(n) + 1 - rank) << n;
        EXPECT_EQ(interval.median, (static_cast<double>(n) + 1) / 2) << n;
    }
}

TEST(MedianInterval, of_fewer_than_six_samples_is_not_known) {
    // The least and the greatest of five hold the median in 1 - 2 / 2^5 = 93.75 % of cases.
    EXPECT_FALSE(median_interval(counted_up(5)).is_known);
    EXPECT_TRUE(median_interval(counted_up(6)).is_known);
    const TimeInterval interval = median_interval({5, 1, 3});
    EXPECT_EQ(interval.low, 1);
    EXPECT_EQ(interval.median, 3);
    EXPECT_EQ(interval.high, 5);
}

TEST(IsSurelySlower, asks_for_both_intervals_and_for_a_gap_between_them) {
    const std::vector<double> quick{1, 2, 3, 4, 5, 6};
    const std::vector<double> slow{7, 8, 9, 10, 11, 12};
    const auto is_slower = [](const std::vector<double>& a, const std::vector<double>& b) {
        return is_surely_slower(median_interval(a), median_interval(b));
    };
    EXPECT_TRUE(is_slower(slow, quick));
    EXPECT_FALSE(is_slower(quick, slow));
    EXPECT_FALSE(is_slower({6, 8, 9, 10, 11, 12}, quick)) << "the ends meet";
    EXPECT_FALSE(is_slower({7, 8, 9, 10, 11}, quick)) << "five samples";
    EXPECT_FALSE(is_slower(slow, {1, 2, 3, 4, 5}));
}

TEST(IsSettled, asks_for_six_samples_within_five_percent) {
    EXPECT_TRUE(is_settled({100, 100, 100, 100, 95, 105}));
    EXPECT_FALSE(is_settled({100, 100, 100, 100, 100}));
    EXPECT_FALSE(is_settled({100, 100, 100, 100, 94, 105}));
    EXPECT_FALSE(is_settled({100, 100, 100, 100, 95, 106}));
    // One outlier of many is outside of the interval.
    EXPECT_TRUE(is_settled({100, 100, 100, 100, 100, 100, 100, 100, 1000}));
}

} // namespace
} // namespace shadowproof
