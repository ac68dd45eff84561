#include "raster/technique.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof::tests {
namespace {

TEST(Technique, each_is_found_by_its_name_and_says_what_it_is) {
    for (const Technique& technique : all_techniques()) {
        EXPECT_EQ(find_technique(technique.name), &technique);
        EXPECT_NE(technique.run, nullptr) << technique.name;
        EXPECT_FALSE(technique.summary.empty()) << technique.name;
        EXPECT_FALSE(technique.source.empty()) << technique.name;
        EXPECT_FALSE(technique.needs.empty()) << technique.name;
    }
    EXPECT_EQ(find_technique("no such technique"), nullptr);
    EXPECT_EQ(find_technique(""), nullptr);
}

TEST(Technique, only_zpass_is_known_to_fail_by_the_near_plane_and_only_zfail_by_the_far_one) {
    for (const Technique& technique : all_techniques()) {
        const auto fails_at = [&](Cause cause) {
            return std::ranges::find(technique.fails_at, cause) != technique.fails_at.end();
        };
        EXPECT_EQ(fails_at(Cause::near_plane), technique.name == "zpass") << technique.name;
        EXPECT_EQ(fails_at(Cause::eye_inside), technique.name == "zpass") << technique.name;
        EXPECT_EQ(fails_at(Cause::far_plane), technique.name == "zfail") << technique.name;
        EXPECT_FALSE(fails_at(Cause::edge)) << technique.name;
        EXPECT_FALSE(fails_at(Cause::unexplained)) << technique.name;
    }
}

} // namespace
} // namespace shadowproof::tests
