#include "compare/bench/kept.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace shadowproof {
namespace {

BenchScene scene(const std::string& name, bool finished = true) {
    return {.name = name,
            .file = name + ".gltf",
            .digest = "digest of " + name,
            .light = "light",
            .width = 10,
            .height = 10,
            .triangles = 12,
            .finished = finished};
}

BenchPoint point(const std::string& scene, const std::string& technique, std::size_t samples = 6) {
    return {.scene = scene,
            .technique = technique,
            .samples = std::vector<double>(samples, 1),
            .error = {.pixels = 100}};
}

Growth line(const std::string& axis, const std::string& technique, std::size_t sizes) {
    Growth growth{.axis = axis, .scene = "dense", .technique = technique, .command = "bench"};
    for (std::size_t i = 0; i < sizes; ++i)
        growth.points.push_back({static_cast<double>(i + 1), {1}});
    return growth;
}

std::vector<std::string> names_of(const BenchRun& run) {
    std::vector<std::string> names;
    for (const BenchPoint& each : run.points) names.push_back(each.scene + " " + each.technique);
    return names;
}

TEST(WithKept, keeps_scenes_and_points_that_the_run_has_not_reached_or_does_not_name) {
    BenchRun earlier;
    earlier.scenes = {scene("a"), scene("b"), scene("c", false)};
    earlier.points = {point("a", "zfail"), point("b", "zfail"), point("b", "zpass"),
                      point("c", "zfail", 2)};
    earlier.points[0].pictures = "pictures/index.html#a/zfail";
    BenchRun run;
    run.scenes = {scene("b")};
    run.points = {point("b", "zfail", 9), point("b", "auto", 0)};
    run.finished = true;
    const BenchRun whole = with_kept(run, earlier);
    EXPECT_EQ(names_of(whole),
              (std::vector<std::string>{"b zfail", "a zfail", "b zpass", "c zfail"}));
    EXPECT_EQ(whole.points[0].samples.size(), 9U) << "the run's own";
    EXPECT_TRUE(whole.points[1].pictures.empty());
    ASSERT_EQ(whole.scenes.size(), 3U);
    EXPECT_EQ(whole.scenes[0].name, "b");
    EXPECT_FALSE(whole.scenes[2].finished);
    EXPECT_FALSE(whole.finished) << "c is not";
}

TEST(WithKept, is_finished_where_all_that_is_kept_is) {
    BenchRun earlier;
    earlier.scenes = {scene("a"), scene("b", false)};
    earlier.points = {point("a", "zfail"), point("b", "zfail")};
    BenchRun run;
    run.scenes = {scene("b")};
    run.points = {point("b", "zfail")};
    run.finished = true;
    EXPECT_TRUE(with_kept(run, earlier).finished);
    EXPECT_TRUE(with_kept(run, earlier).scenes[0].finished);
    // Points of an unfinished scene that were not named now are not finished by it.
    earlier.points.push_back(point("b", "zpass", 1));
    EXPECT_FALSE(with_kept(run, earlier).scenes[0].finished);
    run.finished = false;
    EXPECT_FALSE(with_kept(run, BenchRun()).finished);
}

TEST(WithKept, does_not_mix_points_of_another_picture) {
    BenchRun earlier;
    earlier.scenes = {scene("a")};
    earlier.points = {point("a", "zpass")};
    BenchRun run;
    run.scenes = {scene("a")};
    run.scenes[0].digest = "another";
    run.points = {point("a", "zfail")};
    EXPECT_EQ(names_of(with_kept(run, earlier)), std::vector<std::string>{"a zfail"});
}

TEST(WithKept, keeps_what_was_left_out_until_it_is_measured) {
    BenchRun earlier;
    earlier.left_out = {{"a", "zfail", {}, "lost", Loss::crashed},
                        {"a", "bump_one_pass", {{"bumps", "height-field"}}, "no heights"},
                        {"b.gltf", "", {}, "unreadable"},
                        {"dense", "zfail", {}, "slow", Loss::none, "triangles"}};
    EXPECT_EQ(with_kept(BenchRun(), earlier).left_out.size(), 4U);
    BenchRun run;
    run.scenes = {scene("a"), scene("b")};
    run.points = {point("a", "zfail")};
    run.growth = {line("triangles", "zfail", 2)};
    const BenchRun whole = with_kept(run, earlier);
    ASSERT_EQ(whole.left_out.size(), 1U);
    EXPECT_EQ(whole.left_out[0].why, "no heights");
    run.left_out = {whole.left_out[0]};
    EXPECT_EQ(with_kept(run, earlier).left_out.size(), 1U) << "not twice";
}

TEST(WithKept, keeps_lines_of_growth_and_the_longer_one_of_two) {
    BenchRun earlier;
    earlier.growth = {line("triangles", "zfail", 5), line("pixels", "zfail", 3),
                      line("lights", "zfail", 1)};
    BenchRun run;
    run.growth = {line("triangles", "zfail", 2), line("lights", "zfail", 4)};
    const BenchRun whole = with_kept(run, earlier);
    ASSERT_EQ(whole.growth.size(), 3U);
    EXPECT_EQ(whole.growth[0].points.size(), 5U);
    EXPECT_EQ(whole.growth[1].points.size(), 4U);
    EXPECT_EQ(whole.growth[2].axis, "pixels");
}

} // namespace
} // namespace shadowproof
