#include "raster/technique.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace shadowproof::tests {
namespace {

TEST(Technique, each_is_found_by_its_name_and_says_what_it_is) {
    for (const Technique& technique : all_techniques()) {
        EXPECT_EQ(find_technique(technique.name), &technique);
        EXPECT_EQ((technique.run != nullptr) + (technique.recipe != nullptr) +
                      (technique.map != nullptr),
                  1)
            << technique.name;
        EXPECT_FALSE(technique.summary.empty()) << technique.name;
        EXPECT_FALSE(technique.source.empty()) << technique.name;
        EXPECT_FALSE(technique.needs.empty()) << technique.name;
        EXPECT_GT(technique.cost, 0) << technique.name;
    }
    EXPECT_EQ(find_technique("zfail_reversed")->cost, 1);
    EXPECT_EQ(find_technique("no such technique"), nullptr);
    EXPECT_EQ(find_technique(""), nullptr);
}

TEST(Technique,
     what_counts_in_front_fails_by_the_near_plane_unless_capped_and_only_zfail_by_the_far) {
    const auto among = [](std::string_view name, std::initializer_list<std::string_view> names) {
        return std::ranges::find(names, name) != names.end();
    };
    for (const Technique& technique : all_techniques()) {
        const std::string_view counted_by = technique.name.substr(technique.name.find('+') + 1);
        const auto fails_at = [&](Cause cause) {
            return std::ranges::find(technique.fails_at, cause) != technique.fails_at.end();
        };
        EXPECT_EQ(fails_at(Cause::near_plane),
                  among(counted_by, {"zpass", "zpass_eye_count", "zp_plus", "invert"}))
            << technique.name;
        EXPECT_EQ(fails_at(Cause::eye_inside), among(counted_by, {"zpass", "invert"}))
            << technique.name;
        EXPECT_EQ(fails_at(Cause::light_inside),
                  among(counted_by, {"zpass", "zfail", "zpass_eye_count", "zp_plus", "invert"}))
            << technique.name;
        for (const Cause cause : technique.by_nature) EXPECT_TRUE(fails_at(cause));
        EXPECT_EQ(fails_at(Cause::far_plane), counted_by == "zfail") << technique.name;
        EXPECT_FALSE(fails_at(Cause::edge)) << technique.name;
        EXPECT_FALSE(fails_at(Cause::unexplained)) << technique.name;
    }
}

TEST(Technique, that_lights_may_be_joined_with_one_that_finds_pixels_lit_or_not) {
    for (const std::string_view lighting : lighting_techniques())
        for (const std::string_view shadowing : shadowing_techniques()) {
            const std::string name = std::string(lighting) + "+" + std::string(shadowing);
            const Technique* joined = find_technique(name);
            ASSERT_NE(joined, nullptr) << name;
            EXPECT_EQ(joined->name, name);
            EXPECT_EQ(find_technique(name), joined) << "it stays where it is";
            EXPECT_TRUE(joined->needs_bump_maps);
            EXPECT_EQ(joined->depth_model, find_technique(shadowing)->depth_model);
            for (const Cause cause : find_technique(shadowing)->fails_at)
                EXPECT_NE(std::ranges::find(joined->fails_at, cause), joined->fails_at.end());
        }
    EXPECT_EQ(lighting_techniques().size(), 12U);
    EXPECT_EQ(shadowing_techniques().size(), 24U);
    for (const char* name :
         {"bump_three_pass+zfail_float", "bump_three_pass+cube_map_pcf", "zpass+bump_three_pass",
          "zpass+zfail", "bump_three_pass+", "+zpass", "+", "bump_three_pass+zpass+zfail",
          "bump_three_pass+bump_one_pass", "bump_three_pass+traced_skip"})
        EXPECT_EQ(find_technique(name), nullptr) << name;
}

} // namespace
} // namespace shadowproof::tests
