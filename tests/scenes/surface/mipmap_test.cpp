#include "scenes/load/catalog.h"
#include "scenes/surface/bump_pyramid.h"
#include "scenes/surface/mipmap.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

double unchanged(double value) {
    return value;
}

Image<double> row_of(const std::vector<double>& values) {
    Image<double> image(static_cast<int>(values.size()), 1);
    image.pixels = values;
    return image;
}

TEST(Mipmap, has_levels_down_to_a_single_texel) {
    EXPECT_EQ(levels_of(1, 1), 1);
    EXPECT_EQ(levels_of(3, 1), 2);
    EXPECT_EQ(levels_of(64, 256), 9);
}

TEST(Mipmap, halves_each_side_and_takes_means_of_four) {
    Image<double> texels(4, 2);
    texels.pixels = {1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_EQ(mipmap_level<double>(texels, 0, unchanged).pixels, texels.pixels);
    const Image<double> half = mipmap_level<double>(texels, 1, unchanged);
    EXPECT_EQ(half.width, 2);
    EXPECT_EQ(half.height, 1);
    EXPECT_EQ(half.pixels, (std::vector<double>{3.5, 5.5}));
    EXPECT_EQ(mipmap_level<double>(texels, 2, unchanged).pixels, std::vector<double>{4.5});
}

/// Five texels in two: each covers two and a half.
TEST(Mipmap, of_odd_sizes_weighs_texels_by_what_is_covered) {
    const Image<double> half = mipmap_level<double>(row_of({10, 20, 40, 80, 160}), 1, unchanged);
    ASSERT_EQ(half.width, 2);
    EXPECT_DOUBLE_EQ(half.at(0, 0), (10 + 20 + 40 / 2.0) / 2.5);
    EXPECT_DOUBLE_EQ(half.at(1, 0), (40 / 2.0 + 80 + 160) / 2.5);
}

TEST(Mipmap, keeps_the_mean_of_all_at_every_level) {
    Image<double> texels(13, 7);
    double sum = 0;
    for (std::size_t i = 0; i < texels.pixels.size(); ++i) {
        texels.pixels[i] = static_cast<double>((7 * i * i + 3 * i) % 101);
        sum += texels.pixels[i];
    }
    for (int level = 0; level < levels_of(13, 7); ++level) {
        const Image<double> made = mipmap_level<double>(texels, level, unchanged);
        double of_level = 0;
        for (const double texel : made.pixels) of_level += texel;
        EXPECT_NEAR(of_level / static_cast<double>(made.pixels.size()), sum / (13 * 7), 1e-12)
            << level;
    }
}

TEST(Mipmap, levels_made_of_the_one_before_are_those_made_of_the_finest) {
    for (const auto& [width, height] : {std::pair{16, 8}, std::pair{12, 20}, std::pair{7, 5}}) {
        Image<double> texels(width, height);
        for (std::size_t i = 0; i < texels.pixels.size(); ++i)
            texels.pixels[i] = static_cast<double>((7 * i * i + 3 * i) % 101);
        int number = 0;
        visit_levels<double>(texels, unchanged, [&](const Image<double>& level) {
            const Image<double> right = mipmap_level<double>(texels, number, unchanged);
            ASSERT_EQ(level.width, right.width);
            ASSERT_EQ(level.height, right.height);
            for (std::size_t i = 0; i < right.pixels.size(); ++i)
                EXPECT_NEAR(level.pixels[i], right.pixels[i], 1e-12) << width << ": " << number;
            ++number;
        });
        EXPECT_EQ(number, levels_of(width, height));
    }
}

/// One material with a normal map of such normals, in a row of two.
Scene scene_of(const glm::dvec3& a, const glm::dvec3& b) {
    Scene scene;
    TextureImage& map = scene.textures.emplace_back();
    map.texels = Image<glm::vec4>(2, 1);
    map.texels.at(0, 0) = glm::vec4(0.5 + 0.5 * a, 1);
    map.texels.at(1, 0) = glm::vec4(0.5 + 0.5 * b, 1);
    Material& material = scene.materials.emplace_back();
    material.bump = Bump::normal_map;
    material.bump_map = 0;
    return scene;
}

constexpr double float_error = 1e-6;

TEST(BumpPyramid, of_normals_that_lean_against_each_other_has_a_short_mean) {
    const Scene scene = scene_of({0.6, 0, 0.8}, {-0.6, 0, 0.8});
    const auto top = [&](BumpFilter filter) {
        const BumpPyramid pyramid = bump_pyramid(scene, scene.materials[0], filter);
        EXPECT_EQ(pyramid.levels.size(), 2U);
        EXPECT_EQ(pyramid.cross.size(), filter == BumpFilter::lean ? 2U : 0U);
        return glm::dvec4(pyramid.levels[1].at(0, 0));
    };
    const auto expect_near = [](const glm::dvec4& found, const glm::dvec4& right) {
        EXPECT_LT(glm::length(found - right), float_error);
    };
    expect_near(top(BumpFilter::renormalised), {0, 0, 0.8, 1});
    expect_near(top(BumpFilter::toksvig), {0, 0, 0.8, 1});
    expect_near(top(BumpFilter::dimmed), {0, 0, 1, 0.8});
    // Slopes of 3/4 both ways.
    expect_near(top(BumpFilter::lean), {0, 0, 0.5625, 0});
}

TEST(BumpPyramid, of_slopes_knows_how_they_vary_together) {
    const Scene scene =
        scene_of(glm::normalize(glm::dvec3(1, 1, 2)), glm::normalize(glm::dvec3(-1, -1, 2)));
    const BumpPyramid pyramid = bump_pyramid(scene, scene.materials[0], BumpFilter::lean);
    EXPECT_NEAR(pyramid.levels[1].at(0, 0).z, 0.25, float_error);
    EXPECT_NEAR(pyramid.levels[1].at(0, 0).w, 0.25, float_error);
    EXPECT_NEAR(pyramid.cross[1].at(0, 0).r, 0.25, float_error);
}

TEST(BumpPyramid, reads_slopes_of_no_normal_that_is_steeper_than_a_byte_tells) {
    const Scene scene = scene_of({1, 0, 0}, {0, 0, -1});
    const BumpPyramid pyramid = bump_pyramid(scene, scene.materials[0], BumpFilter::lean);
    EXPECT_NEAR(pyramid.levels[0].at(0, 0).x, 128, 1e-3);
    EXPECT_EQ(pyramid.levels[0].at(1, 0).x, 0);
}

TEST(BumpPyramid, of_a_normal_of_length_zero_points_up) {
    const Scene scene = scene_of({0, 0, 0}, {0, 0, 0});
    for (const BumpFilter filter : {BumpFilter::renormalised, BumpFilter::dimmed}) {
        const BumpPyramid pyramid = bump_pyramid(scene, scene.materials[0], filter);
        for (const Image<glm::vec4>& level : pyramid.levels)
            EXPECT_EQ(level.at(0, 0), glm::vec4(0, 0, 1, 1));
    }
}

TEST(BumpPyramid, has_scaled_normals_before_it_takes_means) {
    Scene scene = scene_of({0.6, 0, 0.8}, {0.6, 0, 0.8});
    scene.materials[0].bump_scale = 0;
    const BumpPyramid pyramid = bump_pyramid(scene, scene.materials[0], BumpFilter::renormalised);
    EXPECT_LT(glm::length(glm::dvec4(pyramid.levels[1].at(0, 0)) - glm::dvec4(0, 0, 1, 1)),
              float_error);
}

} // namespace
} // namespace shadowproof
