#include "compare/memory.h"
#include "scenes/error.h"

#include <gtest/gtest.h>

#include <string>

namespace shadowproof {
namespace {

TEST(Memory, a_picture_that_just_fits_is_taken_and_one_byte_less_refuses_it) {
    EXPECT_NO_THROW(refuse_too_large(100, 10, 7, 7000));
    try {
        refuse_too_large(100, 10, 7, 6999);
        FAIL() << "a picture that does not fit was taken";
    } catch (const Error& error) {
        const std::string words = error.what();
        EXPECT_NE(words.find("--size 100x10: needs at least"), std::string::npos) << words;
        EXPECT_NE(words.find("7 bytes a pixel"), std::string::npos) << words;
    }
}

TEST(Memory, the_largest_size_that_parses_does_not_overflow) {
    EXPECT_THROW(refuse_too_large(16384, 16384, comparison_bytes(1000), 1ULL << 40U), Error);
}

TEST(Memory, what_is_held_grows_with_the_techniques_that_are_kept) {
    EXPECT_EQ(truth_bytes(), 14U); // visibility 1, triangle 4, depth 8, exactness 1
    // Per technique: claim 1, stencil 1, depth 4, triangle 4; cause, miss and prediction 1 each.
    EXPECT_EQ(comparison_bytes(5) - comparison_bytes(4), 13U);
    EXPECT_EQ(comparison_bytes(0), comparison_bytes(1));
}

TEST(Memory, this_machine_has_some) {
    EXPECT_GT(memory_there_is(), 1ULL << 20U);
    EXPECT_NO_THROW(refuse_too_large(64, 64, comparison_bytes(5)));
}

} // namespace
} // namespace shadowproof
