#include "scenes/error.h"
#include "scenes/surface/bump_forms.h"
#include "scenes/surface/relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <string>

namespace shadowproof {
namespace {

constexpr double half_step = 0.5 / 255;
constexpr double float_rounding = 1e-7; // of numbers up to 1

/// Waves as 8-bit heights, or as an 8-bit normal map of them.
Scene waves(Bump kind, double scale) {
    TextureImage heights{.name = "waves", .texels = Image<glm::vec4>(16, 8)};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const double height = 0.5 + 0.25 * std::sin(x * 0.7) * std::cos(y * 1.1);
            heights.texels.at(x, y).r = static_cast<float>(std::round(255 * height) / 255);
        }
    Scene scene;
    scene.file = "waves.gltf";
    if (kind == Bump::normal_map)
        heights.texels =
            converted<glm::vec4>(normal_map_of(slopes_of(heights, 4)), [](const glm::dvec4& n) {
                return glm::vec4(glm::round(255.0 * n) / 255.0);
            });
    scene.textures.push_back(heights);
    scene.materials.push_back({.name = "water", .bump = kind, .bump_map = 0, .bump_scale = scale});
    return scene;
}

/// The perturbed normals at the texels as the asset has them.
Image<glm::dvec3> given_normals(const Scene& scene) {
    const Material& material = scene.materials.front();
    const TextureImage& map = scene.textures.front();
    if (material.bump == Bump::height_field)
        return converted<glm::dvec3>(slopes_of(map, material.bump_scale),
                                     [](const glm::dvec2& slope) {
                                         return glm::normalize(glm::dvec3(-slope.x, slope.y, 1));
                                     });
    return converted<glm::dvec3>(map.texels, [&](const glm::vec4& texel) {
        const glm::dvec3 m = 2.0 * glm::dvec3(texel) - 1.0;
        return glm::normalize(
            glm::dvec3(material.bump_scale * m.x, material.bump_scale * m.y, m.z));
    });
}

TEST(BumpForms, as_given_is_what_the_asset_has) {
    const Scene heights = waves(Bump::height_field, 5);
    const BumpTexels as_heights =
        bump_texels(heights, heights.materials.front(), BumpForm::as_given);
    EXPECT_EQ(as_heights.form, BumpForm::height_field);
    EXPECT_EQ(as_heights.texels.pixels, heights.textures.front().texels.pixels);
    EXPECT_EQ(as_heights.scale, 5);
    const Scene normals = waves(Bump::normal_map, 0.5);
    for (const BumpForm form : {BumpForm::as_given, BumpForm::normal_map}) {
        const BumpTexels as_normals = bump_texels(normals, normals.materials.front(), form);
        EXPECT_EQ(as_normals.form, BumpForm::normal_map);
        EXPECT_EQ(as_normals.texels.pixels, normals.textures.front().texels.pixels);
        EXPECT_EQ(as_normals.scale, 0.5);
    }
}

TEST(BumpForms, normals_of_heights_are_bytes_within_half_a_step) {
    const Scene scene = waves(Bump::height_field, 5);
    const BumpTexels bumps = bump_texels(scene, scene.materials.front(), BumpForm::normal_map);
    EXPECT_EQ(bumps.form, BumpForm::normal_map);
    EXPECT_EQ(bumps.scale, 1); // it is in them
    const Image<glm::dvec3> normals = given_normals(scene);
    for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
        const glm::dvec3 texel(bumps.texels.pixels[i]);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(texel[c] - (0.5 + 0.5 * normals.pixels[i][c])),
                      half_step + float_rounding);
            EXPECT_NEAR(255 * texel[c], std::round(255 * texel[c]), 1e-4);
        }
    }
}

class Derivatives : public testing::TestWithParam<Bump> {};

TEST_P(Derivatives, come_back_within_half_a_step_of_their_range) {
    const Scene scene = waves(GetParam(), GetParam() == Bump::normal_map ? 0.5 : 5);
    const BumpTexels bumps = bump_texels(scene, scene.materials.front(), BumpForm::derivatives);
    EXPECT_EQ(bumps.form, BumpForm::derivatives);
    EXPECT_GT(bumps.slope_range, 0);
    const Image<glm::dvec3> normals = given_normals(scene);
    double largest = 0;
    for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
        const glm::dvec3& n = normals.pixels[i];
        const glm::dvec2 slope = glm::dvec2(-n.x, n.y) / n.z;
        const glm::dvec2 back =
            bumps.slope_range * (2.0 * glm::dvec2(bumps.texels.pixels[i]) - 1.0);
        for (int c = 0; c < 2; ++c) {
            EXPECT_LE(std::abs(back[c] - slope[c]),
                      2 * bumps.slope_range * (half_step + float_rounding));
            largest = std::max(largest, std::abs(slope[c]));
        }
    }
    EXPECT_NEAR(bumps.slope_range, largest, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Of, Derivatives, testing::Values(Bump::normal_map, Bump::height_field),
                         [](const auto& bump) {
                             return bump.param == Bump::normal_map ? "normals" : "heights";
                         });

TEST(BumpForms, a_flat_height_field_has_derivatives_of_some_range) {
    Scene scene = waves(Bump::height_field, 0);
    const BumpTexels bumps = bump_texels(scene, scene.materials.front(), BumpForm::derivatives);
    EXPECT_EQ(bumps.slope_range, 1);
}

TEST(BumpForms, indexed_normals_are_within_the_octahedral_bound) {
    for (const Bump kind : {Bump::normal_map, Bump::height_field}) {
        const Scene scene = waves(kind, 2);
        const BumpTexels bumps = bump_texels(scene, scene.materials.front(), BumpForm::indexed);
        EXPECT_EQ(bumps.form, BumpForm::indexed);
        const Image<glm::dvec3> normals = given_normals(scene);
        for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
            const float number = bumps.texels.pixels[i].r;
            ASSERT_EQ(number, std::floor(number));
            EXPECT_LE(glm::distance(indexed_normal(static_cast<std::uint16_t>(number)),
                                    normals.pixels[i]),
                      octahedral_error);
        }
    }
}

TEST(BumpForms, any_direction_has_a_number_within_the_octahedral_bound) {
    constexpr unsigned seed = 20261122;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937 random(seed);
    std::normal_distribution<double> any;
    double worst = 0;
    for (int i = 0; i < 300'000; ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        worst = std::max(worst, glm::distance(indexed_normal(number_of(n)), n));
    }
    EXPECT_LE(worst, octahedral_error);
    EXPECT_GT(worst, octahedral_error / 4); // the bound is not far off
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 n(0);
            n[axis] = sign;
            EXPECT_LE(glm::distance(indexed_normal(number_of(n)), n), octahedral_error);
        }
}

TEST(BumpForms, every_number_stands_for_a_unit_normal_that_it_is_the_number_of) {
    int others = 0;
    for (int number = 0; number < 65536; ++number) {
        const glm::dvec3 n = indexed_normal(static_cast<std::uint16_t>(number));
        ASSERT_NEAR(glm::length(n), 1, 1e-12);
        if (number_of(n) != number) ++others;
    }
    // On the border of the map two places mean one normal: each but its middle pair of bytes.
    EXPECT_LE(others, 4 * 256);
}

std::string message_of(const Scene& scene, BumpForm form) {
    try {
        bump_texels(scene, scene.materials.front(), form);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(BumpForms, a_form_that_cannot_be_had_is_refused_with_file_material_and_remedy) {
    Scene scene = waves(Bump::normal_map, 1);
    EXPECT_EQ(message_of(scene, BumpForm::height_field),
              "waves.gltf: material 'water': has normals, of which no heights are made; ask for "
              "another form of bumps than height-field");
    scene.textures.front().texels.at(3, 3) = glm::vec4(1, 0.5F, 0.25F, 1);
    EXPECT_NE(message_of(scene, BumpForm::derivatives).find("waves.gltf: material 'water': has "),
              std::string::npos);
    EXPECT_EQ(message_of(scene, BumpForm::indexed), "no error");
}

} // namespace
} // namespace shadowproof
