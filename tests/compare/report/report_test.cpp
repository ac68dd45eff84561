#include "compare/json/blocks.h"
#include "compare/output/write_file.h"
#include "compare/report/escape.h"
#include "compare/report/report_page.h"
#include "scenes/error.h"
#include "tests/compare/handmade_report.h"
#include "tests/scratch_folder.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

namespace shadowproof {
namespace {

namespace fs = std::filesystem;

void write_report(Report report, const fs::path& folder) {
    ReportFolder pages(folder);
    for (SceneResult& scene : report.scenes) {
        if (!scene.error.empty()) continue;
        pages.add_scene(scene);
        for (Cell& cell : scene.cells) pages.add_cell(scene, cell);
    }
    pages.finish(report);
}

struct Scratch : test::ScratchFolder {
    Scratch() : ScratchFolder("report") {}
};

std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[fs::relative(entry.path(), folder).string()] = test::text_in(entry.path());
    return files;
}

TEST(ReportText, a_cells_line_reads_as_the_contract_has_it) {
    SceneResult scene = handmade_scene("near_plane", Cause::edge, Verdict::fails_as_predicted);
    EXPECT_EQ(cell_line(scene, scene.cells[0]),
              "zpass  near_plane  fails_as_predicted  3 of 12 (edge 2, near_plane 1)  first (2,1) "
              "near_plane  3.1 ms");
    scene.cells[0].comparison.evidence.unexplained = 0;
    EXPECT_EQ(cell_line(scene, scene.cells[0], {.technique = 7, .scene = 12, .verdict = 20}),
              "zpass    near_plane    fails_as_predicted     3 of 12 (edge 2, near_plane 1)  first "
              "(2,1) near_plane  3.1 ms");
}

TEST(ReportText, a_cells_line_says_what_was_saved_before_what_was_spent) {
    SceneResult scene = handmade_scene("near_plane", Cause::edge, Verdict::agrees);
    Cell& cell = scene.cells[0];
    std::string line = cell_line(scene, cell);
    CounterEvidence& counted = *cell.frame.counted;
    counted.volume_fragments = 38796;
    counted.saved = {.against = "zfail_reversed",
                     .milliseconds = 1.52,
                     .volume_fragments = 48645,
                     .plan_milliseconds = 0.25};
    cell.comparison.summary = summary_of(cell.frame, cell.comparison.evidence, {});
    line.insert(line.rfind("  "), "  saved 1.5 ms and 48,645 of 87,441 volume fragments against "
                                  "zfail_reversed");
    EXPECT_EQ(cell_line(scene, cell), line);
}

/// The handmade report's first cell with a figure and a picture that are wrong.
Report with_wrong_figures() {
    Report report = handmade_report();
    VolumeCheck volumes;
    volumes.fragments = {.shown = 2408, .predicted = {1204, 1210}};
    volumes.unexplained = 3;
    volumes.first = WrongFaces{.x = 2, .y = 1, .faces = {.shown = 0, .predicted = {2, 2}}};
    Cell& cell = report.scenes[0].cells[0];
    cell.comparison.summary = summary_of(cell.frame, cell.comparison.evidence, volumes);
    return report;
}

TEST(ReportText, a_wrong_figure_is_named_by_every_writer_with_what_was_predicted) {
    const Report report = with_wrong_figures();
    const std::string figure = "volume_fragments 2,408 shown where 1,204 to 1,210 predicted";
    const std::string picture = "picture of the volumes unexplained at 3 pixels, first (2,1): "
                                "faces 0 shown where 2 predicted";
    const SceneResult& scene = report.scenes[0];
    for (const std::string& text :
         {cell_line(scene, scene.cells[0]), why_it_fails(scene.cells[0], report.gate),
          to_json(report), to_junit(report, "2024-01-31T23:59:59"), to_workflow_commands(report),
          to_step_summary(report)}) {
        const auto has = [&](std::string words) {
            return text.find(words) != std::string::npos ||
                   text.find(for_markdown(words)) != std::string::npos;
        };
        EXPECT_TRUE(has(figure)) << text;
        EXPECT_TRUE(has(picture)) << text;
    }
}

TEST(ReportText, a_cell_that_could_not_run_says_why_and_nothing_else) {
    SceneResult scene = handmade_scene("near_plane", Cause::edge, Verdict::agrees);
    scene.cells[0].error = "zpass: blank render; see the driver";
    EXPECT_EQ(cell_line(scene, scene.cells[0]),
              "zpass  near_plane  error  zpass: blank render; see the driver");
}

TEST(ReportText, numbers_are_grouped_by_threes) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(123456789), "123,456,789");
}

TEST(ReportText, the_reproducing_command_is_quoted_for_a_shell) {
    Report report = handmade_report();
    SceneResult& scene = report.scenes[0];
    EXPECT_EQ(reproducing_command(report, scene, scene.cells[0]),
              "shadowproof verify near_plane --technique zpass --size 4x3");
    scene.argument = "it's here; rm -rf/x.glb";
    EXPECT_EQ(reproducing_command(report, scene, scene.cells[0]),
              "shadowproof verify 'it'\\''s here; rm -rf/x.glb' --technique zpass --size 4x3");
}

TEST(ReportJson, the_figures_stand_where_the_contract_has_them) {
    const auto json = nlohmann::json::parse(to_json(handmade_report()));
    EXPECT_EQ(json["schema"], "shadowproof/results/1");
    EXPECT_EQ(json["gl"]["subpixel_bits"], 8);
    const auto& cell = json["scenes"][0]["techniques"][0];
    EXPECT_EQ(cell["pixels"], 12);
    EXPECT_EQ(cell["differing"], 3);
    EXPECT_EQ(cell["causes"], (nlohmann::json{{"edge", 1}, {"near_plane", 2}}));
    EXPECT_EQ(cell["first"], (nlohmann::json{{"x", 2}, {"y", 1}, {"cause", "near_plane"}}));
    EXPECT_EQ(cell["ledger"], (nlohmann::json{{"equal", 11}, {"in_band", 1}, {"unexplained", 0}}));
    EXPECT_EQ(cell["images"]["cause"], "near_plane/zpass.cause.png");
    EXPECT_EQ(json["scenes"][0]["images"]["truth"], "near_plane/truth.png");
}

TEST(ReportJson, a_name_that_is_not_utf8_does_not_break_it) {
    Report report = handmade_report();
    report.scenes[0].name = "a\xff"
                            "b";
    EXPECT_NO_THROW(nlohmann::json::parse(to_json(report)));
}

TEST(ReportJunit, counts_and_messages_are_those_of_the_report) {
    Report report = handmade_report();
    report.scenes[0].name = "<a & \"b\">";
    const std::string xml = to_junit(report, "2024-01-31T23:59:59");
    EXPECT_NE(xml.find("tests=\"1\" failures=\"0\" errors=\"0\""), std::string::npos);
    EXPECT_NE(xml.find("tests=\"1\" failures=\"1\" errors=\"0\""), std::string::npos);
    EXPECT_NE(xml.find("name=\"&lt;a &amp; &quot;b&quot;&gt;\""), std::string::npos);
    EXPECT_NE(xml.find("<failure type=\"unexplained\" message=\"edge 1, near_plane 1, unexplained "
                       "1; first (2,1) near_plane"),
              std::string::npos);
    EXPECT_EQ(xml.find("<a"), std::string::npos);
}

TEST(ReportPage, it_is_the_viewer_with_its_legend_and_no_gap_is_left) {
    const std::string page = report_page();
    EXPECT_EQ(page.find("{{"), std::string::npos);
    for (const CauseWords& cause : all_causes)
        EXPECT_NE(page.find("\"" + std::string(cause.meaning) + "\""), std::string::npos);
    EXPECT_NE(page.find("<script src=\"results.js\">"), std::string::npos);
}

TEST(ReportFolder, times_stand_in_the_results_and_nowhere_else) {
    const Scratch scratch;
    Report report = handmade_report();
    write_report(report, scratch.path / "a");
    report.scenes[0].cells[0].milliseconds = 77.7;
    report.scenes[0].truth.statistics.milliseconds = 88.8;
    write_report(report, scratch.path / "b");
    auto a = files_of(scratch.path / "a");
    auto b = files_of(scratch.path / "b");
    for (const char* file : {"results.json", "results.js", "manifest.json"}) {
        EXPECT_NE(a.at(file), b.at(file));
        a.erase(file);
        b.erase(file);
    }
    EXPECT_EQ(a, b);
}

TEST(ReportFolder, results_js_hands_over_what_results_json_says_but_for_the_cause_maps) {
    const Scratch scratch;
    write_report(handmade_report(), scratch.path / "report");
    auto results =
        nlohmann::ordered_json::parse(test::text_in(scratch.path / "report/results.json"));
    std::size_t maps = 0;
    for (auto& scene : results.at("scenes"))
        for (auto& cell : scene.at("techniques")) maps += cell.erase("cause_map");
    EXPECT_GT(maps, 0U);
    std::string script = test::text_in(scratch.path / "report/results.js");
    const std::string begin = "shadowproof.results(";
    const std::string end = ");\n";
    ASSERT_TRUE(script.starts_with(begin) && script.ends_with(end));
    script = script.substr(begin.size(), script.size() - begin.size() - end.size());
    const auto given = nlohmann::ordered_json::parse(script);
    ASSERT_EQ(given.at("scenes").size(), results.at("scenes").size());
    for (std::size_t i = 0; i < given.at("scenes").size(); ++i) {
        auto& scene = results.at("scenes").at(i);
        const std::string expected = scene.dump();
        const auto bytes = unpacked(given.at("scenes").at(i).get<std::string>(), expected.size());
        ASSERT_TRUE(bytes);
        EXPECT_EQ(std::string(bytes->begin(), bytes->end()), expected);
        scene = given.at("scenes").at(i);
    }
    EXPECT_EQ(given, results);
}

TEST(ReportFolder, two_writings_have_the_same_bytes) {
    const Scratch scratch;
    write_report(handmade_report(), scratch.path / "a");
    write_report(handmade_report(), scratch.path / "b");
    const auto a = files_of(scratch.path / "a");
    EXPECT_EQ(a.size(), 4 + 2 * 6U); // page, results, manifest; two scenes of one cell each
    EXPECT_TRUE(a.contains("index.html"));
    EXPECT_EQ(a, files_of(scratch.path / "b"));
}

TEST(ReportFolder, every_picture_that_results_name_is_there) {
    const Scratch scratch;
    write_report(handmade_report(), scratch.path / "report");
    const auto json = nlohmann::json::parse(test::text_in(scratch.path / "report/results.json"));
    for (const auto& scene : json["scenes"]) {
        EXPECT_TRUE(fs::exists(scratch.path / "report" / scene["images"]["truth"]));
        for (const auto& image : scene["techniques"][0]["images"])
            EXPECT_TRUE(fs::exists(scratch.path / "report" / image)) << image;
    }
}

TEST(ReportFolder, an_older_report_is_replaced_whole) {
    const Scratch scratch;
    Report report = handmade_report();
    write_report(report, scratch.path / "report");
    report.scenes.erase(report.scenes.begin());
    write_report(report, scratch.path / "report/");
    EXPECT_FALSE(fs::exists(scratch.path / "report/near_plane"));
    EXPECT_TRUE(fs::exists(scratch.path / "report/broken/truth.png"));
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path), {}), 1) << "something was left";
}

TEST(ReportFolder, a_folder_that_is_no_report_is_left_alone) {
    const Scratch scratch;
    fs::create_directories(scratch.path / "holiday");
    std::ofstream(scratch.path / "holiday/results.json") << "{\"schema\":\"mine\"}";
    EXPECT_THROW(write_report(handmade_report(), scratch.path / "holiday"), Error);
    EXPECT_EQ(test::text_in(scratch.path / "holiday/results.json"), "{\"schema\":\"mine\"}");
    std::ofstream(scratch.path / "file") << "text";
    EXPECT_THROW(write_report(handmade_report(), scratch.path / "file"), Error);
    EXPECT_EQ(test::text_in(scratch.path / "file"), "text");
}

TEST(ReportFolder, one_that_is_dropped_leaves_the_older_report_and_nothing_else) {
    const Scratch scratch;
    write_report(handmade_report(), scratch.path / "report");
    const auto before = files_of(scratch.path);
    {
        ReportFolder folder(scratch.path / "report");
        SceneResult scene = handmade_report().scenes[0];
        folder.add_scene(scene);
    }
    EXPECT_EQ(files_of(scratch.path), before);
}

TEST(WriteFile, a_file_that_cannot_be_written_is_named_and_not_begun) {
    const Scratch scratch;
    const fs::path file = scratch.path / "missing/results.json";
    try {
        write_file(file, "text");
        FAIL() << "written into a folder that does not exist";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
    }
    fs::create_directories(scratch.path / "taken");
    std::ofstream(scratch.path / "taken/x") << "x";
    EXPECT_THROW(write_file(scratch.path / "taken", "text"), Error);
    EXPECT_EQ(files_of(scratch.path).size(), 1U);
}

} // namespace
} // namespace shadowproof
