// Results read and written scene by scene are those that are read and written whole.
#include "compare/report/growing_results.h"
#include "compare/report/report.h"
#include "compare/results/merge.h"
#include "compare/results/results_index.h"
#include "scenes/error.h"
#include "tests/compare/handmade_report.h"
#include "tests/scratch_folder.h"

#include <gtest/gtest.h>

#include <functional>

namespace shadowproof {
namespace {

namespace fs = std::filesystem;

struct Scratch : test::ScratchFolder {
    Scratch() : ScratchFolder("index") {}
    fs::path file(const std::string& text) const {
        test::put_text(path / "results.json", text);
        return path / "results.json";
    }
};

std::string error_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::string whole_text() {
    Report report = handmade_report();
    for (SceneResult& scene : report.scenes)
        for (Cell& cell : scene.cells)
            if (cell.error.empty() && cell.cause_map.empty())
                cell.cause_map = packed_cause_map(cell.comparison);
    return to_json(report);
}

ResultsJson whole_of(const Merged& merged, const std::vector<IndexedResults>& runs) {
    ResultsJson whole = merged.head;
    for (std::size_t i = 0; i < merged.scenes.size(); ++i)
        whole["scenes"].push_back(whole_scene(merged, i, runs).json);
    return whole;
}

TEST(ResultsIndex, scene_by_scene_results_are_what_they_are_as_a_whole) {
    const Scratch scratch;
    MemoryAccount memory;
    const std::string text = whole_text();
    for (const std::string& form : {text, ResultsJson::parse(text).dump()}) {
        std::vector<IndexedResults> runs;
        runs.push_back(index_results(scratch.file(form), memory));
        EXPECT_EQ(results_text(whole_of(alone(runs.front()), runs)), text);
        const IndexedResults held = index_results(ResultsFile{"held", ResultsJson::parse(text)});
        EXPECT_EQ(held.head, runs.front().head);
        ASSERT_EQ(held.scenes.size(), runs.front().scenes.size());
        for (std::size_t i = 0; i < held.scenes.size(); ++i) {
            EXPECT_EQ(held.scenes[i].head, runs.front().scenes[i].head);
            EXPECT_EQ(held.scene(i), runs.front().scene(i));
        }
    }
}

TEST(ResultsIndex, refuses_what_is_refused_as_a_whole_in_the_same_words) {
    const Scratch scratch;
    const std::string text = whole_text();
    const auto compare = [&](const std::string& spoiled) {
        const fs::path file = scratch.file(spoiled);
        MemoryAccount memory;
        const std::string error = error_of([&] { index_results(file, memory); });
        EXPECT_EQ(error, error_of([&] { read_results(file); })) << spoiled;
        return !error.empty();
    };
    EXPECT_FALSE(compare(text));
    for (std::size_t cut = 0; cut + 1 < text.size(); cut += 7)
        EXPECT_TRUE(compare(text.substr(0, cut))) << cut;
    for (const char* whole : {"", "{}", "[]", "null", "{\"schema\": \"other\"}"})
        EXPECT_TRUE(compare(whole)) << whole;
    const ResultsJson results = ResultsJson::parse(text);
    for (const char* element : {"1", "null", "[]", "[[{}]]", "{}", "\"x\""})
        for (const std::size_t at : {std::size_t{0}, results.at("scenes").size()}) {
            ResultsJson spoiled = results;
            ResultsJson& scenes = spoiled["scenes"];
            scenes.insert(scenes.begin() + static_cast<std::ptrdiff_t>(at),
                          ResultsJson::parse(element));
            EXPECT_TRUE(compare(spoiled.dump())) << element;
        }
    for (const char* scenes : {"{}", "1", "[]", "{\"a\": {\"b\": {}}}"}) {
        ResultsJson spoiled = results;
        spoiled["scenes"] = ResultsJson::parse(scenes);
        EXPECT_TRUE(compare(spoiled.dump())) << scenes;
    }
    std::string deep = text;
    deep.insert(deep.find("\"digest\""),
                "\"x\": " + std::string(100, '[') + std::string(100, ']') + ",");
    EXPECT_TRUE(compare(deep));
}

TEST(ResultsIndex, scenes_that_stand_there_twice_are_refused) {
    const Scratch scratch;
    std::string text = whole_text();
    text.insert(text.find("\"scenes\""), "\"scenes\": [], ");
    const fs::path file = scratch.file(text);
    MemoryAccount memory;
    EXPECT_NE(error_of([&] { index_results(file, memory); }).find("/scenes stands there twice"),
              std::string::npos);
}

TEST(ResultsIndex, a_scene_that_is_too_large_for_memory_is_refused_while_it_is_read) {
    const Scratch scratch;
    std::string text = whole_text();
    text.insert(text.find("\"digest\""),
                "\"x\": \"" + std::string(std::size_t{8} << 20U, 'x') + "\",");
    const fs::path file = scratch.file(text);
    MemoryAccount memory({program_bytes + (std::uint64_t{4} << 20U), "a test"});
    EXPECT_NE(error_of([&] { index_results(file, memory); }).find("one of its scenes"),
              std::string::npos);
    MemoryAccount enough({program_bytes + (std::uint64_t{128} << 20U), "a test"});
    EXPECT_EQ(error_of([&] { index_results(file, enough); }), "");
}

TEST(GrowingResults, have_the_bytes_of_those_that_are_written_at_once) {
    const Scratch scratch;
    const std::string text = whole_text();
    for (const bool with_scenes : {true, false}) {
        ResultsJson head = ResultsJson::parse(text);
        head["baseline"] = {{"file", "b"}, {"passed", true}, {"notes", {"one", "two\n\"three\""}}};
        if (!with_scenes) head["scenes"] = ResultsJson::array();
        const ResultsJson whole = head;
        const ResultsJson scenes = std::exchange(head["scenes"], ResultsJson::array());
        {
            ReportFolder folder(scratch.path / "report");
            GrowingResults results = folder.grow_results(head, "again.json");
            for (const ResultsJson& scene : scenes) results.add(scene);
            results.end();
            folder.finish();
        }
        EXPECT_EQ(test::text_in(scratch.path / "report/results.json"), results_text(whole));
        EXPECT_EQ(test::text_in(scratch.path / "report/again.json"), results_text(whole));
        EXPECT_EQ(test::text_in(scratch.path / "report/results.js"),
                  results_script(results_text(whole)));
    }
}

} // namespace
} // namespace shadowproof
