#include "scenes/load/common/nearest_name.h"

#include <gtest/gtest.h>

namespace shadowproof::test {
namespace {

const std::vector<std::string> names{"ordinary", "near_plane", "zpass", "zfail", "zfail_clamp"};

TEST(nearest_name, is_what_few_letters_make_of_a_word) {
    EXPECT_EQ(nearest_name("ordnary", names), "ordinary");
    EXPECT_EQ(nearest_name("zfial", names), "zfail"); // exchanged
    EXPECT_EQ(nearest_name("near-plane", names), "near_plane");
    EXPECT_EQ(nearest_name("zfail_clmp", names), "zfail_clamp");
    EXPECT_EQ(did_you_mean("ordnary", names), " (did you mean ordinary?)");
}

TEST(nearest_name, is_nothing_for_another_word) {
    EXPECT_EQ(nearest_name("zmaybe", names), "");
    EXPECT_EQ(nearest_name("nowhere.gltf", names), "");
    EXPECT_EQ(nearest_name("", names), "");
    EXPECT_EQ(nearest_name(std::string(100'000, 'z'), names), "");
    EXPECT_EQ(did_you_mean("x", names), "");
}

} // namespace
} // namespace shadowproof::test
