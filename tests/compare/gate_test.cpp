#include "compare/gate.h"
#include "compare/since.h"
#include "tests/compare/handmade_report.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace shadowproof {
namespace {

constexpr Gate defects{.on = GateOn::defects, .allow = {}};
constexpr Gate differences{.on = GateOn::differences, .allow = {}};

Gate allowing(GateOn on, const std::string& text) {
    return {.on = on, .allow = {parse_allowance(text)}};
}

/// near_plane at two pixels, edge at one.
Cell cell_with(Verdict verdict) {
    return handmade_scene("x", Cause::near_plane, verdict).cells[0];
}

TEST(Gate, a_cause_that_is_excused_passes_and_the_same_cause_as_a_defect_fails) {
    EXPECT_FALSE(fails(cell_with(Verdict::fails_as_predicted), defects));
    EXPECT_TRUE(fails(cell_with(Verdict::defect), defects));
}

TEST(Gate, differences_fail_unless_all_of_them_are_edges) {
    EXPECT_TRUE(fails(cell_with(Verdict::fails_as_predicted), differences));
    const Cell edges = handmade_scene("x", Cause::edge, Verdict::agrees).cells[0];
    Cell none = edges;
    none.comparison.causes[static_cast<std::size_t>(Cause::near_plane)] = 0;
    EXPECT_TRUE(fails(edges, differences)); // one of near_plane is left
    EXPECT_FALSE(fails(none, differences));
}

TEST(Gate, a_cause_is_allowed_up_to_its_number_and_not_one_more) {
    const Cell cell = cell_with(Verdict::defect);
    EXPECT_FALSE(fails(cell, allowing(GateOn::defects, "near_plane")));
    EXPECT_FALSE(fails(cell, allowing(GateOn::defects, "near_plane=2")));
    EXPECT_TRUE(fails(cell, allowing(GateOn::defects, "near_plane=1")));
    EXPECT_TRUE(fails(cell, allowing(GateOn::defects, "far_plane")));
    EXPECT_FALSE(fails(cell, allowing(GateOn::differences, "near_plane=2")));
    EXPECT_TRUE(fails(cell, allowing(GateOn::differences, "near_plane=1")));
    EXPECT_EQ(pixels_allowed(cell, allowing(GateOn::defects, "near_plane=2")),
              pixels_that_fail(cell, defects));
}

TEST(Gate, of_an_accepted_cause_only_pixels_that_are_new_since_fail) {
    for (const Gate& gate : {defects, differences}) {
        Cell cell = cell_with(Verdict::defect);
        cell.accepted = {{Cause::near_plane, "known"}};
        EXPECT_TRUE(fails(cell, gate)); // there is no baseline that it was accepted in
        cell.since.emplace();
        EXPECT_FALSE(fails(cell, gate));
        cell.since->causes[static_cast<std::size_t>(Cause::near_plane)] = 1;
        EXPECT_TRUE(fails(cell, gate));
    }
    Cell unexplained = handmade_scene("x", Cause::unexplained, Verdict::defect).cells[0];
    unexplained.since.emplace();
    EXPECT_TRUE(fails(unexplained, defects));
    unexplained.accepted = {{Cause::unexplained, "shadow_map: known"}};
    unexplained.comparison.causes[static_cast<std::size_t>(Cause::near_plane)] = 0;
    EXPECT_FALSE(fails(unexplained, defects));
}

TEST(Gate, unexplained_pixels_and_counters_fail_whatever_is_allowed) {
    Gate gate;
    for (const CauseWords& words : all_causes)
        if (words.cause != Cause::unexplained) gate.allow.push_back({words.cause, {}});
    EXPECT_TRUE(fails(handmade_scene("x", Cause::unexplained, Verdict::defect).cells[0], gate));
    Cell counter = cell_with(Verdict::agrees);
    EXPECT_FALSE(fails(counter, gate));
    counter.comparison.evidence.unexplained = 1;
    EXPECT_TRUE(fails(counter, gate));
}

TEST(Gate, a_figure_that_nothing_makes_fails_whatever_is_allowed) {
    Gate gate;
    for (const CauseWords& words : all_causes)
        if (words.cause != Cause::unexplained) gate.allow.push_back({words.cause, {}});
    Cell cell = cell_with(Verdict::agrees);
    cell.comparison.summary.unexplained = {"2,408 fragments shown where 1,204 predicted"};
    EXPECT_TRUE(fails(cell, gate));
}

TEST(Gate, what_cannot_be_allowed_is_refused_with_what_can) {
    const auto refusal = [](const std::string& text) -> std::string {
        try {
            parse_allowance(text);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_NE(refusal("unexplained").find("cannot be allowed"), std::string::npos);
    EXPECT_NE(refusal("moon").find("near_plane"), std::string::npos);
    for (const char* text : {"edge=", "edge=x", "edge=-1", "edge=1.5", "edge=5 ", "=5", ""})
        EXPECT_FALSE(refusal(text).empty()) << text;
    EXPECT_EQ(words_of(parse_allowance("edge=5")), "edge=5");
    EXPECT_EQ(words_of(parse_allowance("edge")), "edge");
}

TEST(Gate, a_cell_or_scene_that_could_not_run_or_stopped_provoking_fails) {
    SceneResult scene = handmade_scene("x", Cause::near_plane, Verdict::fails_as_predicted);
    EXPECT_FALSE(fails(scene, defects));
    scene.no_longer_provoked = {"far_plane"};
    EXPECT_TRUE(fails(scene, defects));
    scene.no_longer_provoked.clear();
    scene.cells[0].error = "no driver";
    EXPECT_TRUE(fails(scene, defects));
}

Image<std::uint8_t> causes(std::initializer_list<int> values) {
    Image<std::uint8_t> image(static_cast<int>(values.size()), 1);
    std::transform(values.begin(), values.end(), image.pixels.begin(),
                   [](int value) { return static_cast<std::uint8_t>(value); });
    return image;
}

constexpr int none = no_difference;
constexpr int edge = static_cast<int>(Cause::edge);
constexpr int near = static_cast<int>(Cause::near_plane);
constexpr int far = static_cast<int>(Cause::far_plane);

TEST(Since, equal_counts_of_other_pixels_are_a_change) {
    const Since since = changes_since(causes({near, none, near}), causes({near, near, none}));
    EXPECT_EQ(since.appeared, 1U);
    EXPECT_EQ(since.gone, 1U);
    EXPECT_EQ(since.changed, 0U);
    EXPECT_EQ(since.first_new->x, 1);
    EXPECT_EQ(since.first_gone->x, 2);
    EXPECT_EQ(words_of(changes_since(causes({near}), causes({near}))), "unchanged");
}

TEST(Since, another_cause_at_the_same_pixel_is_a_change_and_counts_by_what_it_is_now) {
    const Since since = changes_since(causes({near, edge}), causes({far, none}));
    EXPECT_EQ(since.changed, 1U);
    EXPECT_EQ(since.causes[static_cast<std::size_t>(Cause::far_plane)], 1U);
    EXPECT_EQ(since.causes[static_cast<std::size_t>(Cause::near_plane)], 0U);
    EXPECT_EQ(since.first_changed->was, Cause::near_plane);
}

TEST(Since, the_first_change_named_is_beyond_edges_where_there_is_one) {
    const Since since = changes_since(causes({none, none, none}), causes({edge, far, near}));
    EXPECT_EQ(since.first_new->x, 1);
    EXPECT_EQ(first_of(since)->cause, Cause::far_plane);
}

TEST(Gate, against_a_baseline_only_new_and_changed_pixels_beyond_edges_fail_on_differences) {
    Cell cell = cell_with(Verdict::fails_as_predicted);
    cell.since = Since{};
    EXPECT_FALSE(fails(cell, differences));
    cell.since->gone = 3;
    EXPECT_FALSE(fails(cell, differences));
    cell.since->causes[static_cast<std::size_t>(Cause::edge)] = 1;
    EXPECT_FALSE(fails(cell, differences));
    cell.since->causes[static_cast<std::size_t>(Cause::near_plane)] = 1;
    EXPECT_TRUE(fails(cell, differences));
    EXPECT_FALSE(fails(cell, allowing(GateOn::differences, "near_plane=1")));
}

TEST(Gate, a_baseline_excuses_no_defect) {
    Cell cell = cell_with(Verdict::defect);
    cell.since = Since{};
    EXPECT_TRUE(fails(cell, defects));
}

} // namespace
} // namespace shadowproof
