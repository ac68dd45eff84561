// Set-up of faces that a border of the picture cuts: which thin triangles are left depends on the
// order of corners in which a face is drawn.
#include "compare/driver/setup_error.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace shadowproof {
namespace {

/// A triangle whose corner `beside` lies just beside the picture's right border.
class CutFace : public testing::Test {
protected:
    const CoveredPixel pixel{{0.3, 0, -1}, 1, {.near = 0.1}};

    /// Drawn in this order.
    static Scene drawn(const glm::uvec3& order) {
        Scene scene;
        scene.camera.eye = {0, 0, 5};
        scene.camera.half_height = 0.3;
        scene.camera.width = scene.camera.height = 640;
        scene.positions = {{1.5002F, 0.1F, 0}, {-1.1F, 0.9F, -2}, {-0.7F, -1.2F, -7}};
        scene.triangles = {order};
        scene.lights.emplace_back();
        return scene;
    }

    double error_of(const glm::uvec3& order) const { return setup_error(drawn(order), 0, pixel); }

    double error_of_cap(Crossing::Part part, bool flipped,
                        const std::vector<glm::vec3>* far) const {
        return setup_error(drawn({0, 1, 2}), far, {.part = part, .triangle = 0, .flipped = flipped},
                           pixel);
    }
};

TEST_F(CutFace, has_another_thin_triangle_in_another_order) {
    EXPECT_NE(error_of({0, 1, 2}), error_of({2, 1, 0}));
    EXPECT_NE(error_of({0, 1, 2}), error_of({1, 0, 2}));
}

TEST_F(CutFace, of_a_light_cap_is_drawn_as_the_triangle_was_before_it_was_flipped) {
    const auto cap = Crossing::Part::light_cap;
    EXPECT_EQ(error_of_cap(cap, false, nullptr), error_of({0, 1, 2}));
    EXPECT_EQ(error_of_cap(cap, true, nullptr), error_of({1, 0, 2}));
}

TEST_F(CutFace, of_a_dark_cap_is_drawn_from_the_other_side) {
    const std::vector<glm::vec3> far = drawn({}).positions;
    EXPECT_EQ(error_of_cap(Crossing::Part::dark_cap, false, &far), error_of({2, 1, 0}));
}

/// A sliver of so little height over its base from (0, 0) to (1, 0), in pixels, whose corners are
/// off by a millionth.
std::array<PicturePoint, 3> sliver(double height) {
    const auto at = [](const glm::dvec2& place, double key) {
        return PicturePoint{.place = place, .key = key, .place_error = 1e-6};
    };
    return {at({0, 0}, 0.5), at({1, 0}, 0.6), at({0.5, height}, 0.55)};
}

/// Its area is the height's; corners that move by a millionth each, along both axes, take away as
/// much as a height of some millionths.
TEST(SetUp, knows_no_depth_where_rounded_corners_may_leave_no_area) {
    EXPECT_TRUE(std::isinf(setup_error(sliver(1e-8), {0.5, 0}, 0)));
    EXPECT_TRUE(std::isinf(setup_error(sliver(1e-6), {0.5, 0}, 0)));
    EXPECT_LT(setup_error(sliver(1e-4), {0.5, 0}, 0), 0.1);
    EXPECT_LT(setup_error(sliver(1e-1), {0.5, 0}, 0), 1e-4);
}

/// The driver's own arithmetic, over thin triangles of floats, finds no area in some: each of those
/// is told.
TEST(SetUp, that_finds_no_area_is_foreseen) {
    Dice dice(1);
    int without = 0;
    for (int i = 0; i < 200'000; ++i) {
        std::array<PicturePoint, 3> triangle;
        std::array<glm::vec2, 3> place;
        const double x = dice.between(0, 500);
        const double slope = dice.between(-2, 2);
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = dice.between(0, 30);
            const double off = dice.between(-1, 1) * std::pow(2, -20 - int(dice.below(20)));
            place[k] = glm::vec2(x + along, 300 + slope * along + off);
            triangle[k].place = glm::dvec2(place[k]);
        }
        const glm::vec2 d01 = place[0] - place[1];
        const glm::vec2 d20 = place[2] - place[0];
        const volatile float one = d01.x * d20.y; // rounded by itself
        const volatile float other = d20.x * d01.y;
        if (one - other != 0) continue;
        ++without;
        EXPECT_TRUE(may_have_no_area(triangle)) << i;
    }
    EXPECT_GT(without, 100);
}

/// A thousandth of a pixel is an area.
TEST(SetUp, finds_an_area_where_there_is_one) {
    const auto with_height = [](double height) {
        std::array<PicturePoint, 3> triangle;
        triangle[1].place = {10, 10};
        triangle[2].place = {5, 5 + height};
        return triangle;
    };
    EXPECT_TRUE(may_have_no_area(with_height(0)));
    EXPECT_TRUE(may_have_no_area(with_height(1e-6)));
    EXPECT_FALSE(may_have_no_area(with_height(1e-5)));
    EXPECT_FALSE(may_have_no_area(with_height(1e-3)));
}

} // namespace
} // namespace shadowproof
