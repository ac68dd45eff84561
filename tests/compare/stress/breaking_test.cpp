// Techniques here are functions of a value: what bisection finds is known.
#include "compare/stress/breaking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace shadowproof {
namespace {

StressCell cell(const std::string& technique, std::uint64_t wrong,
                const std::string& cause = "precision") {
    StressCell made{.technique = technique};
    made.error = {.pixels = 100, .differing = wrong + 3, .causes = {{"edge", 3}}};
    if (wrong > 0) made.error.causes.emplace_back(cause, wrong);
    return made;
}

StressPoint point(double value, std::vector<StressCell> cells) {
    StressPoint made{.value = value};
    made.cells = std::move(cells);
    return made;
}

/// The scene as it is at 1, and a ladder on both sides.
StressAlong ladder_of(const std::vector<double>& values,
                      const std::function<std::vector<StressCell>(double)>& cells) {
    StressAlong along;
    for (const double value : values) {
        along.points.push_back(point(value, cells(value)));
        along.points.back().own = value == 1;
    }
    return along;
}

TEST(Breaking, values_between_have_three_digits_and_halve_what_is_left) {
    EXPECT_EQ(value_between(1, 1e-2, false), 0.1);
    EXPECT_EQ(value_between(1e-2, 1, false), 0.1);
    EXPECT_EQ(value_between(1, 1.05, false), std::nullopt);
    EXPECT_EQ(value_between(1e-16, 0, false), std::nullopt);
    EXPECT_EQ(value_between(1, 2, true), std::nullopt);
    EXPECT_EQ(value_between(1, 100, true), 10);
    EXPECT_EQ(value_between(1e-300, 1e300, false), 1);
    EXPECT_EQ(value_between(1, 7, false), 2.65);
}

TEST(Breaking, bisection_ends_within_a_tenth_of_the_value_at_which_a_technique_breaks) {
    const auto cells = [](double value) {
        return std::vector{cell("early", value < 0.07 ? 5 : 0), cell("late", value < 3e-5 ? 2 : 0),
                           cell("never", 0), cell("wrong", 1)};
    };
    StressAlong along = ladder_of({1e-6, 1e-4, 1e-2, 1, 10}, cells);
    int tried = 0;
    while (const auto search = next_search(breaking_points(along, false), false)) {
        ASSERT_LT(++tried, 30);
        std::vector<StressCell> some;
        for (const StressCell& each : cells(search->value))
            if (std::ranges::count(search->techniques, each.technique) > 0) some.push_back(each);
        ASSERT_FALSE(some.empty());
        const auto after =
            std::ranges::upper_bound(along.points, search->value, {}, &StressPoint::value);
        along.points.insert(after, point(search->value, some));
    }
    const std::vector<Breaking> found = breaking_points(along, false);
    ASSERT_EQ(found.size(), 3U); // one was wrong before
    const auto expect_near = [](const Breaking& breaking, double value) {
        ASSERT_TRUE(breaking.fails);
        EXPECT_LT(*breaking.fails, value);
        EXPECT_GE(breaking.holds, value);
        EXPECT_LE(breaking.holds, 1.11 * *breaking.fails);
        EXPECT_EQ(breaking.cause, "precision");
    };
    expect_near(found[0], 0.07);
    expect_near(found[1], 3e-5);
    EXPECT_EQ(found[2].fails, std::nullopt);
    EXPECT_EQ(found[2].holds, 1e-6);
    EXPECT_FALSE(breaking_points(along, true)[0].fails);
}

TEST(Breaking, where_strains_reach_1_is_searched_for_as_well) {
    const auto cells = [](double value) {
        std::vector all{cell("strained", 0), cell("calm", 0), cell("unknown", 0)};
        all[0].strain = 0.03 / value;
        all[1].strain = 0;
        return all;
    };
    StressAlong along = ladder_of({1e-4, 1e-2, 1, 10}, cells);
    int tried = 0;
    while (const auto search = next_search(breaking_points(along, false), false)) {
        ASSERT_LT(++tried, 15);
        ASSERT_EQ(search->techniques, std::vector<std::string>{"strained"});
        const auto after =
            std::ranges::upper_bound(along.points, search->value, {}, &StressPoint::value);
        along.points.insert(after, point(search->value, {cells(search->value)[0]}));
    }
    const std::vector<Breaking> found = breaking_points(along, false);
    ASSERT_TRUE(found[0].derived);
    EXPECT_LE(*found[0].derived, 0.03);
    EXPECT_GT(found[0].derived_holds, 0.03);
    EXPECT_LE(found[0].derived_holds, 1.11 * *found[0].derived);
    EXPECT_FALSE(found[0].fails);
    EXPECT_FALSE(found[1].derived);
    EXPECT_FALSE(found[2].derived);
    EXPECT_FALSE(breaking_points(along, true)[0].derived);
}

TEST(Breaking, what_comes_after_the_first_failure_does_not_count) {
    const StressAlong along = ladder_of(
        {0.01, 0.1, 1}, [](double value) { return std::vector{cell("a", value == 0.1 ? 1 : 0)}; });
    const std::vector<Breaking> found = breaking_points(along, false);
    EXPECT_EQ(found[0].fails, 0.1);
    EXPECT_EQ(found[0].holds, 1);
}

TEST(Breaking, a_scene_that_is_refused_ends_the_search) {
    StressAlong along = ladder_of({0.01, 1}, [](double) { return std::vector{cell("a", 0)}; });
    along.points[0].cells.clear();
    along.points[0].refused = "too small";
    const std::vector<Breaking> found = breaking_points(along, false);
    EXPECT_EQ(found[0].fails, 0.01);
    EXPECT_EQ(found[0].cause, "refused");
    EXPECT_FALSE(next_search(found, false));
}

TEST(Breaking, counters_that_nobody_explains_are_a_failure_too) {
    StressCell unexplained = cell("a", 0);
    unexplained.verdict = Verdict::unexplained;
    EXPECT_TRUE(has_failed(unexplained));
    EXPECT_FALSE(has_failed(cell("a", 0)));
    StressAlong along = ladder_of({0.01, 1}, [](double) { return std::vector{cell("a", 0)}; });
    along.points[0].cells = {unexplained};
    EXPECT_EQ(breaking_points(along, false)[0].cause, "unexplained");
}

TEST(Breaking, the_tally_counts_points_cells_and_what_truth_was_held_to) {
    StressRun run;
    run.scenes.push_back({});
    StressAlong along = ladder_of({1, 10}, [](double) { return std::vector{cell("a", 0)}; });
    along.points[1].cells[0].verdict = Verdict::unexplained;
    along.points[1].witness = {.asked = 7, .disagreements = 1};
    along.points[1].relations = {.tried = {"moved", "split"}, .changed = 3};
    StressPoint refused{.value = 100};
    refused.refused = "no";
    along.points.push_back(refused);
    run.scenes[0].parameters.push_back(along);
    const StressTally tally = tally_of(run);
    EXPECT_EQ(tally.points, 2U);
    EXPECT_EQ(tally.cells, 2U);
    EXPECT_EQ(tally.unexplained, 1U);
    EXPECT_EQ(tally.asked, 7U);
    EXPECT_EQ(tally.disagreements, 1U);
    EXPECT_EQ(tally.relations_tried, 2U);
    EXPECT_EQ(tally.changed, 3U);
}

} // namespace
} // namespace shadowproof
