#include "scenes/surface/mipmap.h"
#include "scenes/surface/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace shadowproof {
namespace {

/// h = A (1 + sin(k x)) (1 + cos(l y)) / 4, x and y in texels; repeats after 64 of them.
struct Waves {
    double k = 2 * std::numbers::pi * 3 / 64;
    double l = 2 * std::numbers::pi * 2 / 64;
    double scale = 9; ///< A, texels

    double height(double x, double y) const {
        return (1 + std::sin(k * x)) * (1 + std::cos(l * y)) / 4;
    }
    glm::dvec2 slope(double x, double y) const {
        return scale / 4 *
               glm::dvec2(k * std::cos(k * x) * (1 + std::cos(l * y)),
                          -l * (1 + std::sin(k * x)) * std::sin(l * y));
    }
    /// Of a central difference over one texel to either side: a sixth of the largest third
    /// derivative (Taylor, with the remainder of the third order).
    glm::dvec2 difference_error() const { return scale / 2 / 6 * glm::dvec2(k * k * k, l * l * l); }
    /// Of n = (-s, t, 1) / |(-s, t, 1)| by errors of s and t: its derivatives are no longer than 1.
    double normal_error(double height_rounding) const {
        return glm::length(difference_error() + glm::dvec2(scale * height_rounding));
    }
};

glm::dvec3 true_normal(const glm::dvec2& slope) {
    return glm::normalize(glm::dvec3(-slope.x, slope.y, 1));
}

Image<double> heights_of(const Waves& waves, double steps) {
    Image<double> heights(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            heights.at(x, y) = std::round(waves.height(x + 0.5, y + 0.5) * steps) / steps;
    return heights;
}

/// The largest distance of a decoded normal from the surface's own, the map rounded to bytes.
double worst_error(const Image<glm::dvec4>& map, const Waves& waves) {
    double worst = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            glm::dvec3 n(0);
            for (int c = 0; c < 3; ++c) n[c] = std::round(map.at(x, y)[c] * 255) / 255 * 2 - 1;
            worst = std::max(worst, glm::distance(n, true_normal(waves.slope(x + 0.5, y + 0.5))));
        }
    return worst;
}

// Half a step of 8 bits in each of three components, which span two units.
const double byte_error = std::sqrt(3) / 255;

TEST(relief, normals_of_an_analytic_surface_lie_within_the_bound_of_differences_and_bytes) {
    const Waves waves;
    for (const double steps : {65535.0, 255.0}) {
        // Two heights, each off by half a step, over two texels: half a step.
        const double bound = waves.normal_error(0.5 / steps) + byte_error;
        EXPECT_LT(bound, 0.1) << "a bound that says nothing";
        const Image<glm::dvec2> slopes =
            slopes_of(heights_of(waves, steps), Wrap::repeat, Wrap::repeat, waves.scale);
        EXPECT_LT(worst_error(normal_map_of(slopes), waves), bound);
    }
}

TEST(relief, a_wrong_scale_a_green_that_points_down_and_another_wrap_leave_the_bound) {
    const Waves waves;
    const double bound = waves.normal_error(0.5 / 65535) + byte_error;
    const Image<double> heights = heights_of(waves, 65535);
    const auto map_of = [&](Wrap wrap, double scale) {
        return normal_map_of(slopes_of(heights, wrap, wrap, scale));
    };
    EXPECT_GT(worst_error(map_of(Wrap::repeat, 1.2 * waves.scale), waves), bound);
    EXPECT_GT(worst_error(map_of(Wrap::clamp_to_edge, waves.scale), waves), bound);
    Image<glm::dvec4> flipped = map_of(Wrap::repeat, waves.scale);
    for (glm::dvec4& texel : flipped.pixels) texel.g = 1 - texel.g;
    EXPECT_GT(worst_error(flipped, waves), bound);
}

TEST(relief, borders_take_the_neighbour_that_the_wrap_mode_names) {
    Image<double> heights(4, 1);
    heights.pixels = {0, 1, 3, 7};
    const auto slope_at = [&](Wrap wrap, int x) {
        return slopes_of(heights, wrap, Wrap::repeat, 1).at(x, 0).x;
    };
    EXPECT_EQ(slope_at(Wrap::repeat, 0), (1 - 7) / 2.0);
    EXPECT_EQ(slope_at(Wrap::repeat, 3), (0 - 3) / 2.0);
    for (const Wrap wrap : {Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
        EXPECT_EQ(slope_at(wrap, 0), (1 - 0) / 2.0);
        EXPECT_EQ(slope_at(wrap, 1), (3 - 0) / 2.0);
        EXPECT_EQ(slope_at(wrap, 3), (7 - 3) / 2.0);
    }
    EXPECT_EQ(slopes_of(heights, Wrap::repeat, Wrap::repeat, 1).at(1, 0).y, 0); // a single row
}

TEST(relief, levels_above_hold_the_mean_normal_and_its_length) {
    // Two rows of slopes 1 and -1 to the right: normals (-1, 0, 1) and (1, 0, 1) over sqrt 2.
    Image<glm::dvec2> slopes(2, 2);
    slopes.pixels = {{1, 0}, {-1, 0}, {1, 0}, {-1, 0}};
    const Image<glm::dvec4> map = normal_map_of(slopes, 1);
    ASSERT_EQ(map.width, 1);
    EXPECT_NEAR(glm::distance(map.at(0, 0), glm::dvec4(0.5, 0.5, 1, std::sqrt(0.5))), 0, 1e-15);
    for (const glm::dvec4& texel : normal_map_of(slopes).pixels) EXPECT_EQ(texel.a, 1);
}

TEST(relief, a_level_of_an_odd_size_weighs_texels_by_what_is_covered_of_them) {
    Image<glm::dvec2> slopes(3, 1);
    slopes.pixels = {{1, 0}, {0, 0}, {0, 0}}; // one texel covers all three
    const glm::dvec3 mean = (true_normal({1, 0}) + 2.0 * glm::dvec3(0, 0, 1)) / 3.0;
    const glm::dvec4 texel = normal_map_of(slopes, 1).at(0, 0);
    EXPECT_NEAR(texel.a, glm::length(mean), 1e-15);
}

} // namespace
} // namespace shadowproof
