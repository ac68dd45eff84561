#include "compare/bench/rounds.h"

#include <gtest/gtest.h>

#include <string>

namespace shadowproof {
namespace {

/// A clock that every sample moves on by its own time.
struct Story {
    std::string order; ///< the points as they were measured, a line break after each round
    double seconds = 0;
    std::vector<std::vector<double>> samples;

    void measure(const RoundLimits& limits, const std::vector<std::vector<double>>& times,
                 double seconds_each) {
        samples.resize(times.size());
        measure_in_rounds(samples, limits,
                          {.measure =
                               [&](std::size_t i) {
                                   order += static_cast<char>('a' + i);
                                   seconds += seconds_each;
                                   return times[i][samples[i].size() % times[i].size()];
                               },
                           .seconds = [&] { return seconds; },
                           .before = [](std::size_t) {},
                           .after_round = [&] { order += ' '; }});
    }
};

TEST(MeasureInRounds, goes_through_all_points_there_and_back) {
    Story story;
    story.measure({.repeats = 3, .seconds = 100}, {{1}, {2}, {3}}, 0.1);
    EXPECT_EQ(story.order, "abc cba abc ");
}

TEST(MeasureInRounds, leaves_a_settled_point_alone_and_goes_on_with_the_others) {
    Story story;
    story.measure({.repeats = 8, .seconds = 100}, {{1}, {1, 2}}, 0.1);
    EXPECT_EQ(story.samples[0].size(), 6U);
    EXPECT_EQ(story.samples[1].size(), 8U);
}

TEST(MeasureInRounds, measures_each_point_once_even_where_there_is_no_time) {
    Story story;
    story.measure({.repeats = 50, .seconds = 0}, {{1}, {2}, {3}}, 1);
    EXPECT_EQ(story.order, "abc ");
}

TEST(MeasureInRounds, begins_no_sample_after_the_limit) {
    Story story;
    story.measure({.repeats = 50, .seconds = 4.5}, {{1, 9}, {1, 9}}, 1);
    EXPECT_EQ(story.order, "ab ba a ");
}

TEST(MeasureInRounds, lets_a_point_that_takes_seconds_wait_until_the_others_are_done) {
    Story story;
    story.measure({.repeats = 3, .seconds = 100}, {{1, 2}, {5000, 9000}, {3, 4}}, 0.1);
    EXPECT_EQ(story.order, "abc ca ac b b ");
    Story short_story;
    short_story.measure({.repeats = 3, .seconds = 0.5}, {{1, 2}, {5000, 9000}, {3, 4}}, 0.1);
    EXPECT_EQ(short_story.order, "abc ca ");
}

TEST(MeasureInRounds, goes_on_with_the_samples_that_there_are) {
    Story story;
    story.samples = {{1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1}};
    story.measure({.repeats = 50, .seconds = 100}, {{1}, {1}}, 1);
    EXPECT_EQ(story.order, "b ");
}

} // namespace
} // namespace shadowproof
