#include "raster/technique.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace shadowproof::tests {
namespace {

TEST(Technique, each_is_found_by_its_name_and_says_what_it_is) {
    for (const Technique& technique : all_techniques()) {
        EXPECT_EQ(find_technique(technique.name), &technique);
        EXPECT_NE(technique.run, nullptr) << technique.name;
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
        const auto fails_at = [&](Cause cause) {
            return std::ranges::find(technique.fails_at, cause) != technique.fails_at.end();
        };
        EXPECT_EQ(fails_at(Cause::near_plane),
                  among(technique.name, {"zpass", "zpass_eye_count", "zp_plus", "invert"}))
            << technique.name;
        EXPECT_EQ(fails_at(Cause::eye_inside), among(technique.name, {"zpass", "invert"}))
            << technique.name;
        EXPECT_EQ(fails_at(Cause::light_inside),
                  among(technique.name, {"zpass", "zfail", "zpass_eye_count", "zp_plus", "invert"}))
            << technique.name;
        for (const Cause cause : technique.by_nature) EXPECT_TRUE(fails_at(cause));
        EXPECT_EQ(fails_at(Cause::far_plane), technique.name == "zfail") << technique.name;
        EXPECT_FALSE(fails_at(Cause::edge)) << technique.name;
        EXPECT_FALSE(fails_at(Cause::unexplained)) << technique.name;
    }
}

} // namespace
} // namespace shadowproof::tests
