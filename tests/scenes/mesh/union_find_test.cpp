#include "scenes/mesh/union_find.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace shadowproof {
namespace {

TEST(UnionFind, the_smallest_number_stands_for_all_that_were_united) {
    UnionFind sets(6);
    EXPECT_EQ(sets.find(5), 5U);
    sets.unite(5, 3);
    sets.unite(4, 5);
    EXPECT_EQ(sets.find(4), 3U);
    EXPECT_EQ(sets.find(2), 2U);
    sets.unite(4, 1);
    EXPECT_EQ(sets.find(5), 1U);
}

TEST(UnionFind, has_the_sets_that_renaming_one_by_one_makes) {
    constexpr std::uint32_t count = 200;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Dice dice(seed);
        UnionFind sets(count);
        std::vector<std::uint32_t> smallest(count);
        std::iota(smallest.begin(), smallest.end(), 0U);
        for (int n = 0; n < 150; ++n) {
            const auto a = static_cast<std::uint32_t>(dice.below(count));
            const auto b = static_cast<std::uint32_t>(dice.below(count));
            sets.unite(a, b);
            const auto [from, to] = std::minmax({smallest[a], smallest[b]});
            std::replace(smallest.begin(), smallest.end(), to, from);
        }
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(sets.find(i), smallest[i]) << "seed " << seed;
    }
}

} // namespace
} // namespace shadowproof
