#include "reference/predict/prediction.h"
#include "reference/predict/tally.h"

#include <gtest/gtest.h>

#include <vector>

namespace shadowproof {
namespace {

/// Side faces in the order of drawing, with depth fail's steps; none is certain.
std::vector<PossibleFace> steps(const std::vector<int>& by) {
    std::vector<PossibleFace> faces;
    for (std::size_t i = 0; i < by.size(); ++i) {
        Crossing face;
        face.part = Crossing::Part::side_0;
        face.edge = static_cast<std::uint32_t>(i);
        face.change = by[i] * weight(Counting::Test::depth_fail);
        faces.push_back({face, false});
    }
    return faces;
}

using Counts = std::vector<std::int64_t>;

TEST(PossibleCounts, a_step_down_at_zero_is_lost_and_the_step_up_after_it_is_not) {
    const Counting saturating{.operation = Counting::Operation::saturate};
    EXPECT_EQ(possible_counts_of_sum(steps({-1, 1}), 0, 0, saturating, 0), (Counts{0, 1}));
    EXPECT_EQ(possible_counts_of_sum(steps({1, -1}), 0, 0, saturating, 0), (Counts{0}));
}

TEST(PossibleCounts, a_sum_that_no_choice_of_faces_has_has_no_counts) {
    const Counting saturating{.operation = Counting::Operation::saturate};
    EXPECT_TRUE(possible_counts_of_sum(steps({1, 1}), 0, 0, saturating, 3).empty());
    EXPECT_TRUE(possible_counts_of_sum(steps({1, 1}), 0, 0, saturating, -1).empty());
}

TEST(PossibleCounts, of_a_counter_that_wraps_each_sum_is_its_own_count) {
    for (const std::int64_t sum : {-2, -1, 0, 1})
        EXPECT_EQ(possible_counts_of_sum(steps({-1, 1, -1}), 0, 0, {}, sum), (Counts{sum}));
    EXPECT_EQ(possible_counts(steps({-1, 1, -1}), 0, 0, {}), (Counts{-2, -1, 0, 1}));
}

} // namespace
} // namespace shadowproof
