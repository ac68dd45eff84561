#include "compare/blank.h"
#include "scenes/error.h"
#include "scenes/scene.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

Frame frame_of(std::uint32_t last) {
    Frame frame;
    frame.triangle = Image<std::uint32_t>(3, 2, no_triangle);
    frame.triangle.pixels.back() = last;
    return frame;
}

GroundTruth truth_of(std::uint64_t lit, std::uint64_t shadowed) {
    GroundTruth truth;
    truth.statistics.lit = lit;
    truth.statistics.shadowed = shadowed;
    return truth;
}

TEST(Blank, a_frame_without_a_surface_is_refused_by_the_name_of_its_technique) {
    for (const GroundTruth& truth : {truth_of(1, 0), truth_of(0, 1)}) {
        try {
            refuse_blank("zpass", truth, frame_of(no_triangle), true);
            FAIL() << "a blank render was taken";
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find("zpass: blank render"), 0U);
        }
    }
}

TEST(Blank, a_frame_without_a_surface_is_taken_where_that_is_explained) {
    EXPECT_NO_THROW(refuse_blank("zpass", truth_of(1, 0), frame_of(no_triangle), false));
}

TEST(Blank, one_surface_is_enough_and_a_scene_of_background_may_be_blank) {
    EXPECT_NO_THROW(refuse_blank("zpass", truth_of(1, 1), frame_of(7), true));
    EXPECT_NO_THROW(refuse_blank("zpass", truth_of(0, 0), frame_of(no_triangle), true));
}

TEST(Blank, a_truth_in_which_nothing_is_seen_is_refused_and_one_surface_is_enough) {
    EXPECT_THROW(refuse_blank_truth("hall", truth_of(0, 0)), Error);
    EXPECT_NO_THROW(refuse_blank_truth("hall", truth_of(1, 0)));
    EXPECT_NO_THROW(refuse_blank_truth("hall", truth_of(0, 1)));
}

TEST(Blank, a_truth_without_shadow_or_without_light_is_noted) {
    EXPECT_NE(note_if_one_class_is_seen(truth_of(1, 0))->find("in shadow"), std::string::npos);
    EXPECT_NE(note_if_one_class_is_seen(truth_of(0, 1))->find("in light"), std::string::npos);
    EXPECT_FALSE(note_if_one_class_is_seen(truth_of(1, 1)));
}

} // namespace
} // namespace shadowproof
