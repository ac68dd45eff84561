#include "compare/bench/against.h"
#include "compare/bench/bench_csv.h"
#include "compare/bench/bench_file.h"
#include "compare/bench/bench_json.h"
#include "compare/bench/bench_table.h"
#include "scenes/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace shadowproof {
namespace {

BenchPoint point(const std::string& technique, double ms, std::uint64_t wrong) {
    BenchPoint point{
        .scene = "ordinary",
        .technique = technique,
        .family = "stencil",
        .settings = {},
        .own = {},
        .samples = std::vector<double>(6, ms),
        .error = {.pixels = 100, .differing = wrong + 2, .falsely_lit = static_cast<double>(wrong)},
        .command = "shadowproof bench ordinary --technique " + technique};
    point.error.causes = {{"edge", 2}};
    if (wrong > 0) point.error.causes.emplace_back("near_plane", wrong);
    return point;
}

BenchRun run_of(std::vector<BenchPoint> points) {
    BenchRun run;
    run.version = "1";
    run.scenes = {{.name = "ordinary",
                   .file = "ordinary.gltf",
                   .digest = "0123456789abcdef",
                   .light = "light",
                   .width = 10,
                   .height = 10,
                   .triangles = 12,
                   .finished = true}};
    run.points = std::move(points);
    run.finished = true;
    return run;
}

TEST(ChangesBetween, finds_none_in_equal_runs) {
    const BenchRun run = run_of({point("zpass", 3, 5), point("zfail", 4, 0)});
    const BenchChanges changes = changes_between(run, run);
    EXPECT_EQ(changes.compared, 2U);
    EXPECT_TRUE(changes.losses.empty());
    EXPECT_TRUE(changes.gains.empty());
    EXPECT_TRUE(changes.notes.empty());
}

TEST(ChangesBetween, names_a_time_beyond_both_intervals_and_none_within) {
    BenchRun older = run_of({point("zpass", 3, 0), point("zfail", 3, 0)});
    BenchRun newer = run_of({point("zpass", 3.1, 0), point("zfail", 3.1, 0)});
    older.points[1].samples[0] = 3.2; // reaches over the newer one
    const BenchChanges changes = changes_between(older, newer);
    ASSERT_EQ(changes.losses.size(), 1U);
    EXPECT_EQ(changes.losses[0],
              "ordinary zpass: 3.100 ms [3.100, 3.100], was 3.000 [3.000, 3.000]");
    EXPECT_EQ(changes_between(newer, older).gains.size(), 1U);
}

TEST(ChangesBetween, calls_no_time_lost_or_gained_without_both_intervals) {
    const BenchRun older = run_of({point("zpass", 3, 0), point("zfail", 3, 0)});
    BenchRun newer = run_of({point("zpass", 30, 0), point("zfail", 30, 0)});
    newer.points[0].samples.pop_back(); // five are left
    for (const bool back : {false, true}) {
        const BenchChanges changes =
            back ? changes_between(newer, older) : changes_between(older, newer);
        ASSERT_EQ((back ? changes.gains : changes.losses).size(), 1U);
        EXPECT_NE((back ? changes.gains : changes.losses)[0].find("zfail"), std::string::npos);
        EXPECT_TRUE((back ? changes.losses : changes.gains).empty());
        ASSERT_EQ(changes.notes.size(), 1U);
        EXPECT_EQ(changes.notes[0], "the times of 1 point are not compared: fewer than 6 samples "
                                    "have no interval");
    }
}

TEST(ChangesBetween, still_names_wrong_pixels_of_points_without_intervals) {
    const BenchRun older = run_of({point("zpass", 3, 5)});
    BenchRun newer = run_of({point("zpass", 3, 6)});
    newer.points[0].samples = {3};
    EXPECT_EQ(changes_between(older, newer).losses.size(), 1U);
}

TEST(ChangedOrders, are_those_beyond_all_four_intervals_and_no_others) {
    const BenchRun older = run_of({point("a", 3, 0), point("b", 4, 0), point("c", 5, 0)});
    EXPECT_TRUE(changed_orders(older, older).empty());
    BenchRun newer = run_of({point("a", 4.5, 0), point("b", 4, 0), point("c", 5, 0)});
    const std::vector<ChangedOrder> changed = changed_orders(older, newer);
    ASSERT_EQ(changed.size(), 1U);
    EXPECT_EQ(newer.points[changed[0].quicker].technique, "b");
    EXPECT_EQ(newer.points[changed[0].slower].technique, "a");
    EXPECT_EQ(changes_between(older, newer).orders,
              std::vector<std::string>{"ordinary b is quicker than ordinary a now, and was slower, "
                                       "beyond all intervals"});
    // Within an interval of either run, an order is not known, and so does not change.
    newer.points[0].samples[0] = 4;
    EXPECT_TRUE(changed_orders(older, newer).empty());
    newer.points[0].samples = {4.5, 4.5, 4.5, 4.5, 4.5};
    EXPECT_TRUE(changed_orders(older, newer).empty()) << "five samples";
    // Nor on another picture.
    newer = run_of({point("a", 4.5, 0), point("b", 4, 0)});
    newer.scenes[0].digest = "another";
    EXPECT_TRUE(changed_orders(older, newer).empty());
}

TEST(ChangedOrders, are_not_found_in_samples_of_the_same_times_with_noise) {
    // Twenty points whose true medians are 1 % apart, and two runs of 20 samples with noise of a
    // tenth, to one side as a busy machine's is: each pair that is apart in both runs is in order.
    std::mt19937 random(16);
    std::exponential_distribution<double> noise(10);
    const auto run = [&] {
        std::vector<BenchPoint> points;
        for (int i = 0; i < 20; ++i) {
            points.push_back(point("t" + std::to_string(i), 1, 0));
            points.back().samples.clear();
            for (int k = 0; k < 20; ++k)
                points.back().samples.push_back(std::pow(1.01, i) * (1 + noise(random)));
        }
        return run_of(points);
    };
    const BenchRun first = run();
    EXPECT_TRUE(changed_orders(first, run()).empty());
}

TEST(ChangesBetween, names_every_further_wrong_pixel) {
    const BenchRun older = run_of({point("zpass", 3, 5)});
    const BenchRun newer = run_of({point("zpass", 3, 6)});
    ASSERT_EQ(changes_between(older, newer).losses.size(), 1U);
    EXPECT_EQ(changes_between(older, newer).losses[0], "ordinary zpass: 6 pixels wrong, was 5");
    EXPECT_EQ(changes_between(newer, older).gains.size(), 1U);
}

TEST(ChangesBetween, does_not_compare_other_pictures) {
    const BenchRun older = run_of({point("zpass", 3, 5)});
    BenchRun newer = run_of({point("zpass", 9, 50)});
    newer.scenes[0].width = 20;
    const BenchChanges changes = changes_between(older, newer);
    EXPECT_EQ(changes.compared, 0U);
    EXPECT_TRUE(changes.losses.empty());
    EXPECT_EQ(changes.notes.size(), 1U);
}

TEST(ChangesBetween, says_that_the_machine_is_another) {
    const BenchRun older = run_of({point("zpass", 3, 5)});
    BenchRun newer = older;
    newer.machine.processor = "another";
    EXPECT_EQ(changes_between(older, newer).notes.size(), 1U);
}

TEST(BenchJson, comes_back_as_it_was) {
    BenchRun run = run_of({point("zpass", 3, 5), point("zfail", 4, 0)});
    run.points[1].settings = {{"normalise", "exact"}};
    run.points[1].own = {{"normalise", "exact"}, {"bumps", "as-given"}};
    run.points[1].error.color = BenchColor{0.25, 3, 2};
    run.points[1].stages = {{"volumes", run.points[1].samples},
                            {"counting", run.points[1].samples}};
    run.left_out = {{"ordinary", "zp_plus", {{"bumps", "indexed"}}, "why"},
                    {"ordinary", "zfail", {}, "slow", Loss::none, "pixels"}};
    run.growth = {{.axis = "pixels",
                   .scene = "ordinary",
                   .technique = "zfail",
                   .family = "stencil",
                   .command = "shadowproof bench",
                   .points = {{100, {1}}, {1000, {2}}, {10000, {4}}}}};
    const ResultsJson json = ResultsJson::parse(bench_json(run).dump());
    EXPECT_NO_THROW(check_bench(json, "run.json"));
    const BenchRun back = bench_of_json(json);
    EXPECT_EQ(bench_json(back).dump(), json.dump());
}

TEST(CheckBench, names_the_figure_that_contradicts_another) {
    const ResultsJson good = ResultsJson::parse(bench_json(run_of({point("zpass", 3, 5)})).dump());
    const auto refusal = [&](const std::function<void(ResultsJson&)>& change) {
        ResultsJson json = good;
        change(json);
        try {
            check_bench(json, "run.json");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    using Json = ResultsJson;
    const auto with_stage = [&](const Json& stage) {
        return refusal([&](Json& json) { json["points"][0]["stages"]["counting"] = stage; });
    };
    const Json ms = good["points"][0]["ms"];
    EXPECT_EQ(with_stage({{"median", ms["median"]}, {"samples", ms["samples"]}}), "accepted");
    EXPECT_NE(with_stage({{"median", 1e9}, {"samples", ms["samples"]}}).find("/median"),
              std::string::npos);
    EXPECT_NE(with_stage({{"median", 1}, {"samples", Json::array({1})}}).find("/samples"),
              std::string::npos);
    EXPECT_NE(with_stage(Json::object()).find("/points/0/stages/counting"), std::string::npos);
    EXPECT_NE(refusal([](Json& json) { json["points"][0]["stages"] = 3; }).find("an object"),
              std::string::npos);
    EXPECT_EQ(refusal([](Json& json) {
                  json["schema"] = "shadowproof/results/1";
              }).rfind("run.json: /schema must be", 0),
              0U);
    EXPECT_NE(refusal([](Json& json) { json["points"][0]["differing"] = 9U; }).find("/causes"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& json) { json["points"][0]["ms"]["low"] = 1; }).find("/points/0/ms"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& json) {
                  json["points"][0]["ms"]["interval"] = false;
              }).find("/points/0/ms/interval"),
              std::string::npos);
    EXPECT_EQ(refusal([](Json& json) { json["points"][0]["ms"].erase("interval"); }), "accepted")
        << "an older file";
    EXPECT_NE(refusal([](Json& json) {
                  json["points"].push_back(json["points"][0]);
              }).find("/points/1 is the same point as /points/0"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& json) { json["points"][0].erase("ms"); }).find("lacks \"ms\""),
              std::string::npos);
    EXPECT_NE(refusal([](Json& json) {
                  json["points"][0]["ms"]["samples"][2] = -1;
              }).find("/points/0/ms/samples/2"),
              std::string::npos);
}

TEST(BenchTable, has_a_star_where_no_other_is_as_quick_and_as_right) {
    const BenchRun run = run_of(
        {point("slow", 9, 0), point("quick", 1, 5), point("right", 3, 0), point("worse", 4, 6)});
    const std::vector<std::string> lines = bench_table(run, "ordinary");
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_EQ(lines[1].rfind("* quick", 0), 0U);
    EXPECT_EQ(lines[2].rfind("* right", 0), 0U);
    EXPECT_EQ(lines[3].rfind("  worse", 0), 0U);
    EXPECT_EQ(lines[4].rfind("  slow", 0), 0U);
    EXPECT_TRUE(bench_table(run, "another").empty());
}

TEST(BenchTable, says_where_there_is_no_interval) {
    BenchRun run = run_of({point("zpass", 3, 5), point("zfail", 4, 0)});
    run.points[1].samples.pop_back();
    const std::vector<std::string> lines = bench_table(run, "ordinary");
    EXPECT_EQ(lines[1].find("no interval"), std::string::npos);
    EXPECT_NE(lines[2].find("no interval    5"), std::string::npos);
    EXPECT_NE(bench_csv(run).find("ordinary,zfail,,4,,,5,false,"), std::string::npos);
}

TEST(BenchCsv, quotes_what_separates) {
    BenchRun run = run_of({point("zpass", 3, 5)});
    run.points[0].command = "shadowproof bench 'a,\"b\".gltf'";
    const std::string csv = bench_csv(run);
    EXPECT_NE(csv.find(",\"shadowproof bench 'a,\"\"b\"\".gltf'\"\r\n"), std::string::npos);
    EXPECT_NE(csv.find("ordinary,zpass,,3,3,3,6,true,100,5,0.05,0.05,0,,,,2,5,"),
              std::string::npos);
}

TEST(BenchCsv, of_growth_has_a_line_per_technique_and_size) {
    BenchRun run = run_of({});
    run.growth = {{.axis = "pixels",
                   .scene = "ordinary",
                   .technique = "zfail",
                   .family = "stencil",
                   .command = "shadowproof bench --scaling",
                   .points = {{100, {1, 1, 1, 1, 1, 1}}, {1000, {10}}, {10000, {100}}}}};
    const std::string csv = bench_csv(run);
    EXPECT_NE(csv.find("\r\npixels,ordinary,zfail,100,1,1,1,6,true,1,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\r\npixels,ordinary,zfail,1000,10,,,1,false,1,"), std::string::npos);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
}

} // namespace
} // namespace shadowproof
