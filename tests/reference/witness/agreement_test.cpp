#include "reference/witness/agreement.h"
#include "scenes/load/catalog.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

constexpr int width = 40;
constexpr int height = 30;

Scene loaded(const char* name) {
    SceneRequest request;
    request.width = width;
    request.height = height;
    return load_scene(name, request);
}

TEST(Agreement, witness_and_truth_agree_where_filters_decide_and_where_they_do_not) {
    for (const char* name : {"ordinary", "light_in_plane", "eye_on_side", "spot"}) {
        const Scene scene = loaded(name);
        const Agreement agreement = ask_witness(scene, trace(Tracer(scene)), 200, 0);
        EXPECT_EQ(agreement.asked, 200U);
        EXPECT_EQ(agreement.disagreements, 0U) << name << ": " << words_of(agreement);
    }
}

TEST(Agreement, half_of_the_pixels_are_those_that_filters_could_not_decide) {
    const Scene scene = loaded("light_in_plane");
    const GroundTruth truth = trace(Tracer(scene));
    std::uint64_t undecided = 0;
    for (const Exactness exactness : truth.exactness.pixels)
        undecided += exactness != Exactness::filtered ? 1 : 0;
    ASSERT_GT(undecided, 20U);
    EXPECT_GE(ask_witness(scene, truth, 40, 0).undecided, 20U);
    const Agreement all = ask_witness(scene, truth, 1'000'000, 0);
    EXPECT_EQ(all.asked, std::uint64_t{width} * height);
    EXPECT_EQ(all.undecided, undecided);
}

TEST(Agreement, a_truth_that_is_wrong_at_one_pixel_is_told) {
    const Scene scene = loaded("ordinary");
    GroundTruth truth = trace(Tracer(scene));
    const auto expect_told = [&](const char* words) {
        const Agreement agreement = ask_witness(scene, truth, 1'000'000, 0);
        EXPECT_EQ(agreement.disagreements, 1U);
        ASSERT_TRUE(agreement.first);
        EXPECT_EQ(agreement.first->x, 17);
        EXPECT_EQ(agreement.first->y, 21);
        EXPECT_NE(words_of(agreement).find(words), std::string::npos) << words_of(agreement);
    };
    Visibility& class_there = truth.visibility.at(17, 21);
    const Visibility right = class_there;
    class_there = right == Visibility::lit ? Visibility::shadowed : Visibility::lit;
    expect_told("1 disagree, the first at (17,21)");
    class_there = right;
    std::uint32_t& triangle_there = truth.triangle.at(17, 21);
    triangle_there = triangle_there == 0 ? 1 : 0;
    expect_told("1 disagree, the first at (17,21)");
}

TEST(Agreement, any_number_of_threads_asks_the_same) {
    const Scene scene = loaded("eye_on_side");
    const GroundTruth truth = trace(Tracer(scene));
    EXPECT_EQ(words_of(ask_witness(scene, truth, 100, 1)),
              words_of(ask_witness(scene, truth, 100, 3)));
}

} // namespace
} // namespace shadowproof
