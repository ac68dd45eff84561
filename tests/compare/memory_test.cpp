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
    EXPECT_THROW(refuse_too_large(16384, 16384, comparison_bytes(), 1ULL << 33U), Error);
}

TEST(Memory, each_picture_that_is_held_counts) {
    EXPECT_EQ(truth_bytes(), 14U); // visibility 1, triangle 4, depth 8, exactness 1
    // Four shadow depths of 4, and again with the prediction, 4; claim 1, counter 4, volumes 1,
    // depth 4, triangle 4; cause 1, miss 1, prediction 4; and in OpenGL claim 1, triangle 4, sum 4,
    // depth and stencil 4.
    EXPECT_EQ(comparison_bytes() - truth_bytes(), 16U + 20U + 14U + 6U + 13U);
}

TEST(Memory, this_machine_has_some) {
    EXPECT_GT(memory_there_is(), 1ULL << 20U);
    EXPECT_NO_THROW(refuse_too_large(64, 64, comparison_bytes()));
}

} // namespace
} // namespace shadowproof
