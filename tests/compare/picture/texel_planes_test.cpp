// Which squares a shadow map may have, by the ends that a picture shows.
#include "compare/picture/texel_planes.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace shadowproof {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Its camera stands 2 to the right of the origin, and 1 up.
Light sun() {
    Light light;
    light.kind = Light::Kind::directional;
    light.position = {2, 1, 5};
    return light;
}

LightFrustum ends(glm::dvec2 low, glm::dvec2 high) {
    LightFrustum frustum;
    frustum.low = {low, -infinity};
    frustum.high = {high, infinity};
    return frustum;
}

std::optional<MapSquare> exact_square(const LightFrustum& frustum) {
    std::optional<MapSquare> found;
    for (const MapSquare& square : measured_squares(frustum, sun()))
        if (!square.is_measured) {
            EXPECT_FALSE(found) << "side " << found->side << ", and " << square.side;
            found = square;
        }
    return found;
}

TEST(MeasuredSquares, two_ends_that_are_equally_far_tell_whose_middle_it_is) {
    const auto square = exact_square(ends({-infinity, -infinity}, {5.004, 3.997}));
    ASSERT_TRUE(square);
    EXPECT_DOUBLE_EQ(square->side, 6);
    EXPECT_DOUBLE_EQ(square->low->x, -1);
    EXPECT_DOUBLE_EQ(square->low->y, -2);
}

TEST(MeasuredSquares, ends_that_are_not_equally_far_tell_none_around_a_middle) {
    EXPECT_FALSE(exact_square(ends({-infinity, -infinity}, {5.004, 3.5})));
}

TEST(MeasuredSquares, a_middle_beyond_an_end_is_none) {
    EXPECT_FALSE(exact_square(ends({2.5, -infinity}, {infinity, infinity})));
}

TEST(MeasuredSquares, opposite_ends_tell_a_side_wherever_it_lies) {
    const auto squares = measured_squares(ends({2.5, -infinity}, {10.5, infinity}), sun());
    ASSERT_EQ(squares.size(), 1U);
    EXPECT_DOUBLE_EQ(squares.front().side, 8);
    EXPECT_FALSE(squares.front().low);
}

TEST(TexelPlanes, a_square_too_far_away_for_parts_of_texels_may_lie_anywhere) {
    ShadowSteps steps;
    steps.steps.push_back({{0.5, 0.5}, {0.01, 0.01}});
    const MapSquare near{{}, 10, glm::dvec2(-5), false};
    EXPECT_TRUE(divided(steps, near, 1024).is_exact);
    const MapSquare far{{}, 10, glm::dvec2(1e16), false};
    EXPECT_FALSE(divided(steps, far, 1024).is_exact);
}

} // namespace
} // namespace shadowproof
