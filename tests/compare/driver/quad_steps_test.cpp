// Differences of texture coordinates between the pixels of a quad: of exact triangles, and of those
// whose corners a driver has snapped.
#include "compare/driver/quad_steps.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

namespace shadowproof {
namespace {

/// A triangle before a camera of 64x64 pixels, and texture coordinates of its corners.
struct Drawn {
    Scene scene;
    std::array<glm::dvec2, 3> values{};
};

Drawn random_triangle(Dice& dice) {
    Drawn drawn;
    drawn.scene.camera.eye = {0, 0, 0};
    drawn.scene.camera.half_height = 0.5;
    drawn.scene.camera.width = drawn.scene.camera.height = 64;
    for (int k = 0; k < 3; ++k) {
        const double depth = dice.between(2, 20);
        drawn.scene.positions.emplace_back(dice.between(-0.4, 0.4) * depth,
                                           dice.between(-0.4, 0.4) * depth, -depth);
        drawn.values[static_cast<std::size_t>(k)] = {dice.between(-3, 3), dice.between(-3, 3)};
    }
    drawn.scene.triangles = {{0, 1, 2}};
    drawn.scene.lights.emplace_back();
    return drawn;
}

/// Where the ray meets the triangle's plane, as weights: by a linear equation of its own.
glm::dvec2 value_along(const Scene& scene, const std::array<glm::dvec2, 3>& values,
                       const glm::dvec3& direction) {
    const glm::dmat3 corners(corner(scene, 0, 0), corner(scene, 0, 1), corner(scene, 0, 2));
    glm::dvec3 weights = glm::inverse(corners) * direction;
    weights /= weights.x + weights.y + weights.z;
    return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

QuadRays rays_at(const Scene& scene, const glm::dvec2& place, double half) {
    QuadRays quad;
    const Camera& camera = scene.camera;
    quad.to_column = line_of_sight(camera, 1, 0) - line_of_sight(camera, 0, 0);
    quad.to_row = line_of_sight(camera, 0, 1) - line_of_sight(camera, 0, 0);
    const std::array<glm::dvec2, 4> corners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 at = place + half * corners[i];
        quad.rays[i] = line_of_sight(camera, at.x, at.y);
    }
    return quad;
}

TEST(QuadSteps, of_exact_pixels_are_the_differences_of_their_values) {
    Dice dice(1);
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
        const Drawn drawn = random_triangle(dice);
        const glm::dvec2 place(dice.between(8, 56), dice.between(8, 56));
        const auto at = [&](double x, double y) {
            return value_along(drawn.scene, drawn.values,
                               line_of_sight(drawn.scene.camera, place.x + x, place.y + y));
        };
        const PlaceSteps steps =
            quad_steps(drawn.scene, 0, drawn.values, rays_at(drawn.scene, place, 0));
        if (!std::isfinite(steps.across[0].low) || !std::isfinite(steps.down[0].low)) continue;
        ++compared;
        for (std::size_t k = 0; k < 2; ++k) {
            const auto axis = static_cast<int>(k);
            const double across = at(1, 0)[axis] - at(0, 0)[axis];
            const double down = at(0, 1)[axis] - at(0, 0)[axis];
            EXPECT_NEAR(steps.across[k].middle(), across, 1e-6 * std::abs(across) + 1e-9);
            EXPECT_NEAR(steps.down[k].middle(), down, 1e-6 * std::abs(down) + 1e-9);
        }
    }
    EXPECT_GT(compared, 900);
}

/// The corners are moved in the picture, as a driver may snap them, and keep their depths: what it
/// interpolates is then linear over the moved triangle, over depth.
glm::dvec2 value_when_moved(const Drawn& drawn, const std::array<glm::dvec2, 3>& moves,
                            const glm::dvec2& place) {
    std::array<glm::dvec3, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 at = corner(drawn.scene, 0, static_cast<int>(k));
        const glm::dvec2 pixel = project(drawn.scene.camera, at) + moves[k];
        corners[k] = -at.z * line_of_sight(drawn.scene.camera, pixel.x, pixel.y);
    }
    glm::dvec3 weights = glm::inverse(glm::dmat3(corners[0], corners[1], corners[2])) *
                         line_of_sight(drawn.scene.camera, place.x, place.y);
    weights /= weights.x + weights.y + weights.z;
    return weights.x * drawn.values[0] + weights.y * drawn.values[1] + weights.z * drawn.values[2];
}

/// Snapped corners change steps by no more than the bound; and the bound is of use.
TEST(QuadSteps, of_a_triangle_whose_corners_are_snapped_are_within_their_range) {
    Dice dice(2);
    int judged = 0;
    double tightest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20000; ++i) {
        const Drawn drawn = random_triangle(dice);
        const double reach = dice.between(0.001, 0.05);
        const glm::dvec2 place(dice.between(8, 56), dice.between(8, 56));
        const CoveredPixel pixel{
            line_of_sight(drawn.scene.camera, place.x, place.y), reach, {.near = 0.1}};
        QuadRays quad = rays_at(drawn.scene, place, reach);
        const double way = i % 2 == 0 ? 1 : -1; // to the next neighbour, or the one before
        quad.to_column *= way;
        quad.to_row *= way;
        quad.stretch = drawn_stretch(drawn.scene, 0, pixel);
        const PlaceSteps steps = quad_steps(drawn.scene, 0, drawn.values, quad);
        if (!std::isfinite(steps.across[0].low) || !std::isfinite(steps.down[0].low)) continue;
        const glm::dvec3 weights = [&] {
            const glm::dmat3 corners(corner(drawn.scene, 0, 0), corner(drawn.scene, 0, 1),
                                     corner(drawn.scene, 0, 2));
            return glm::inverse(corners) * pixel.line;
        }();
        if (weights.x < 0 || weights.y < 0 || weights.z < 0) continue; // not on the triangle
        std::array<glm::dvec2, 3> moves{};
        for (glm::dvec2& move : moves)
            move = {dice.between(-reach, reach), dice.between(-reach, reach)};
        const glm::dvec2 here = value_when_moved(drawn, moves, place);
        const glm::dvec2 next = value_when_moved(drawn, moves, place + glm::dvec2(way, 0));
        const glm::dvec2 below = value_when_moved(drawn, moves, place + glm::dvec2(0, way));
        for (std::size_t k = 0; k < 2; ++k) {
            const double step = next[static_cast<int>(k)] - here[static_cast<int>(k)];
            const double down = below[static_cast<int>(k)] - here[static_cast<int>(k)];
            EXPECT_TRUE(steps.across[k].contains(step)) << i << ": " << step;
            EXPECT_TRUE(steps.down[k].contains(down)) << i << ": " << down;
            const Interval& range = steps.across[k];
            tightest = std::min(tightest, (range.high - range.low) / std::abs(step));
        }
        ++judged;
    }
    EXPECT_GT(judged, 1000);
    EXPECT_LT(tightest, 0.01);
}

TEST(QuadSteps, of_a_triangle_that_ends_between_the_pixels_may_be_any) {
    Dice dice(3);
    Drawn drawn = random_triangle(dice);
    // A plane through the eye's horizon: seen along the row y = 32, from just below.
    drawn.scene.positions = {{-1, -0.001F, -2}, {1, -0.001F, -2}, {0, -0.001F, -40}};
    const PlaceSteps steps =
        quad_steps(drawn.scene, 0, drawn.values, rays_at(drawn.scene, {32.3, 31.9}, 0));
    EXPECT_TRUE(std::isinf(steps.down[0].low) && std::isinf(steps.down[0].high));
}

TEST(QuadSteps, are_taken_towards_the_neighbour_in_the_quad) {
    EXPECT_EQ(quad_neighbours(4, 7, 8).column, 1);
    EXPECT_EQ(quad_neighbours(5, 7, 8).column, -1);
    // OpenGL's first row is the picture's last: of 8 rows 7 pairs with 6, of 7 rows 6 with 5.
    EXPECT_EQ(quad_neighbours(4, 7, 8).row, -1);
    EXPECT_EQ(quad_neighbours(4, 6, 8).row, 1);
    EXPECT_EQ(quad_neighbours(4, 6, 7).row, -1);
    EXPECT_EQ(quad_neighbours(4, 5, 7).row, 1);
}

} // namespace
} // namespace shadowproof
