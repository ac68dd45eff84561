// What cells are taken to cost: as measured, or like others.
#include "compare/command/verify/costs.h"
#include "raster/technique.h"
#include "scenes/load/catalog.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

TEST(Costs, a_cell_costs_what_it_did_and_another_what_its_technique_does_by_triangles) {
    Costs costs;
    costs.add(ResultsJson::parse(R"({"scenes": [
        {"name": "a", "triangles": 0, "spent_ms": 7,
         "techniques": [{"name": "zpass", "spent_ms": 10}, {"name": "zfail", "spent_ms": 90}]},
        {"name": "b", "triangles": 8000, "spent_ms": 10,
         "techniques": [{"name": "zpass", "spent_ms": 60}, {"name": "zfail"}]},
        {"name": "c", "triangles": 0, "techniques": [{"name": "zpass", "spent_ms": 20}]}]})"));
    EXPECT_EQ(costs.of_cell("a", "zfail", 0), 90'000U);
    EXPECT_EQ(costs.of_cell("b", "zpass", 8000), 60'000U);
    // Of 10, 20 and 30 without triangles; 16,000 make it three times that.
    EXPECT_EQ(costs.of_cell("d", "zpass", 0), 20'000U);
    EXPECT_EQ(costs.of_cell("d", "zpass", 16'000), 60'000U);
    EXPECT_EQ(costs.of_cell("b", "zfail", 8000), 180'000U);
    EXPECT_EQ(costs.of_scene("a", 0), 7'000U);
    // What was measured later counts.
    costs.add(ResultsJson::parse(
        R"({"scenes": [{"name": "a", "techniques": [{"name": "zfail", "spent_ms": 1}]}]})"));
    EXPECT_EQ(costs.of_cell("a", "zfail", 0), 1'000U);
    EXPECT_EQ(costs.of_cell("a", "zpass", 0), 10'000U);
}

TEST(Costs, of_nothing_that_was_measured_are_alike) {
    const Costs none;
    EXPECT_EQ(none.of_cell("a", "zpass", 100), none.of_cell("b", "zfail", 100));
    EXPECT_GT(none.of_cell("a", "zpass", 0), 0U);
}

TEST(Costs, what_is_no_time_is_passed_over) {
    for (const char* text :
         {"null", "[]", R"({"scenes": 1})", R"({"scenes": [1, null, {}]})",
          R"({"scenes": [{"name": "a", "techniques": [{"name": "zpass", "spent_ms": "x"}]}]})",
          R"({"scenes": [{"name": "a", "techniques": [{"name": "zpass", "spent_ms": -1}, 3]}]})"}) {
        Costs costs;
        costs.add(ResultsJson::parse(text));
        EXPECT_EQ(costs.of_cell("a", "zpass", 0), Costs().of_cell("a", "zpass", 0)) << text;
    }
    Costs costs;
    costs.add(ResultsJson::parse(
        R"({"scenes": [{"name": "a", "techniques": [{"name": "zpass", "spent_ms": 1e300}]}]})"));
    EXPECT_GT(costs.of_cell("a", "zpass", 0), 1'000'000U); // and no overflow
}

/// Where this fails, a scene or technique is new: see tests/bench/costs.mjs.
TEST(Costs, every_bundled_scene_and_technique_was_measured) {
    const ResultsJson measured = bundled_costs();
    ASSERT_TRUE(measured.contains("scenes"));
    std::set<std::string> techniques;
    std::set<std::string> scenes;
    for (const ResultsJson& scene : measured.at("scenes")) {
        EXPECT_GT(scene.at("spent_ms").get<double>(), 0);
        const auto name = scene.at("name").get<std::string>();
        for (const BundledScene& bundled : bundled_scenes())
            if (name == bundled.name || name.starts_with(std::string(bundled.name) + "-"))
                scenes.emplace(bundled.name);
        for (const ResultsJson& cell : scene.at("techniques")) {
            EXPECT_GT(cell.at("spent_ms").get<double>(), 0);
            techniques.insert(cell.at("name").get<std::string>());
        }
    }
    for (const BundledScene& scene : bundled_scenes())
        EXPECT_TRUE(scenes.contains(std::string(scene.name))) << scene.name;
    for (const Technique& technique : all_techniques())
        EXPECT_TRUE(techniques.contains(std::string(technique.name))) << technique.name;
}

} // namespace
} // namespace shadowproof
