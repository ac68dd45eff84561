#include "compare/stencil/stencil_report.h"
#include "compare/verdict.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

Comparison with(std::initializer_list<Cause> causes) {
    Comparison comparison;
    for (const Cause cause : causes) comparison.causes[static_cast<std::size_t>(cause)] = 5;
    return comparison;
}

Scene declaring(std::vector<Cause> provokes) {
    Scene scene;
    scene.provokes = std::move(provokes);
    scene.declares_provokes = true;
    return scene;
}

const std::vector<Cause> zpass_fails_at{Cause::near_plane, Cause::precision};

TEST(Verdict, edge_pixels_alone_agree) {
    EXPECT_EQ(judge(declaring({}), zpass_fails_at, {}, with({Cause::edge})), Verdict::agrees);
}

TEST(Verdict, precision_where_the_numbers_suffice_is_a_defect_and_excused_nowhere) {
    Comparison comparison = with({Cause::precision});
    EXPECT_EQ(judge(declaring({}), zpass_fails_at, {}, comparison), Verdict::fails_as_predicted);
    EXPECT_EQ(excused_causes(declaring({}), zpass_fails_at, {}, comparison),
              std::vector{Cause::precision});
    comparison.too_near = 1;
    EXPECT_EQ(judge(declaring({}), zpass_fails_at, {}, comparison), Verdict::defect);
    EXPECT_TRUE(excused_causes(declaring({}), zpass_fails_at, {}, comparison).empty());
}

TEST(Verdict, a_figure_that_the_volumes_do_not_make_is_unexplained) {
    const auto verdict_of = [](const VolumeCheck& volumes) {
        Frame frame;
        frame.counted.emplace();
        Comparison comparison;
        comparison.summary = summary_of(frame, {}, volumes);
        return judge(declaring({}), zpass_fails_at, {}, comparison);
    };
    VolumeCheck volumes;
    volumes.fragments = {.shown = 11, .predicted = {11, 12}};
    EXPECT_EQ(verdict_of(volumes), Verdict::agrees);
    volumes.fragments.shown = 13;
    EXPECT_EQ(verdict_of(volumes), Verdict::unexplained);
    volumes.fragments.shown = 12;
    volumes.unexplained = 1;
    EXPECT_EQ(verdict_of(volumes), Verdict::unexplained);
}

TEST(Verdict, a_known_failing_that_the_scene_provokes_is_as_predicted) {
    EXPECT_EQ(judge(declaring({Cause::near_plane}), zpass_fails_at, {}, with({Cause::near_plane})),
              Verdict::fails_as_predicted);
}

TEST(Verdict, a_known_failing_that_the_scene_does_not_provoke_is_a_defect) {
    EXPECT_EQ(judge(declaring({}), zpass_fails_at, {}, with({Cause::near_plane})), Verdict::defect);
}

TEST(Verdict, a_known_failing_that_the_scene_may_provoke_is_as_predicted_and_is_not_missed) {
    Scene scene = declaring({Cause::near_plane});
    scene.may_provoke = {Cause::extrusion};
    EXPECT_EQ(judge(scene, std::vector{Cause::extrusion}, {}, with({Cause::extrusion})),
              Verdict::fails_as_predicted);
    EXPECT_EQ(judge(scene, zpass_fails_at, {}, with({Cause::extrusion})), Verdict::defect);
}

TEST(Verdict, a_failing_that_the_technique_is_not_known_for_is_a_defect) {
    EXPECT_EQ(judge(declaring({Cause::far_plane}), zpass_fails_at, {}, with({Cause::far_plane})),
              Verdict::defect);
}

TEST(Verdict, a_scene_that_declares_nothing_may_provoke_any_known_failing_but_no_other) {
    EXPECT_EQ(judge(Scene{}, zpass_fails_at, {}, with({Cause::near_plane})),
              Verdict::fails_as_predicted);
    EXPECT_EQ(judge(Scene{}, zpass_fails_at, {}, with({Cause::cap})), Verdict::defect);
}

TEST(Verdict, precision_needs_a_technique_that_is_known_for_it_and_no_scene_that_declares_it) {
    EXPECT_EQ(judge(declaring({}), zpass_fails_at, {}, with({Cause::precision})),
              Verdict::fails_as_predicted);
    EXPECT_EQ(judge(declaring({}), {}, {}, with({Cause::precision})), Verdict::defect);
}

TEST(Verdict, an_unexplained_pixel_outweighs_everything) {
    EXPECT_EQ(judge(declaring({Cause::near_plane}), zpass_fails_at, {},
                    with({Cause::near_plane, Cause::unexplained})),
              Verdict::unexplained);
}

TEST(Verdict, a_counter_that_was_not_predicted_is_unexplained_though_every_claim_is_right) {
    Comparison comparison;
    comparison.evidence.unexplained = 1;
    EXPECT_EQ(judge(declaring({}), zpass_fails_at, {}, comparison), Verdict::unexplained);
}

TEST(Verdict, a_scene_that_stops_provoking_what_it_declares_is_named) {
    const std::vector<std::vector<Cause>> fails_at{zpass_fails_at};
    const Scene scene = declaring({Cause::near_plane});
    const auto shows = [](Cause shown) { return [=](Cause cause) { return cause == shown; }; };
    EXPECT_TRUE(no_longer_provoked(scene.provokes, fails_at, shows(Cause::near_plane)).empty());
    EXPECT_EQ(no_longer_provoked(scene.provokes, fails_at, shows(Cause::edge)),
              std::vector<Cause>{Cause::near_plane});
}

TEST(Verdict, a_cause_that_no_technique_shown_is_known_for_is_not_missed) {
    const std::vector<std::vector<Cause>> fails_at{{Cause::far_plane}};
    EXPECT_TRUE(no_longer_provoked(declaring({Cause::near_plane}).provokes, fails_at, [](Cause) {
                    return false;
                }).empty());
}

} // namespace
} // namespace shadowproof
