#include "compare/driver/lighting/lighting_tables.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "scenes/surface/relief.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <optional>

namespace shadowproof {
namespace {

/// None where the material cannot have the form.
std::optional<BumpTexels> drawn_texels(const Scene& scene, const Material& material,
                                       BumpForm form) {
    try {
        return bump_texels(scene, material, form);
    } catch (const Error&) {
        return std::nullopt;
    }
}

TEST(LightingTables, of_every_bundled_bump_map_are_those_that_techniques_draw_with) {
    int compared = 0;
    for (const BundledScene& each : bundled_scenes()) {
        const Scene scene = load_scene(std::string(each.name), {});
        for (const Material& material : scene.materials) {
            if (material.bump == Bump::none) continue;
            for (const BumpForm form : all_bump_forms) {
                SCOPED_TRACE(std::string(each.name) + " " + std::string(name_of(form)));
                const auto drawn = drawn_texels(scene, material, form);
                if (!drawn) continue;
                const BumpTexels expected = expected_bump_texels(scene, material, form);
                EXPECT_EQ(expected.form, drawn->form);
                EXPECT_EQ(expected.texels.pixels, drawn->texels.pixels);
                EXPECT_EQ(expected.scale, drawn->scale);
                EXPECT_DOUBLE_EQ(expected.slope_range, drawn->slope_range);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 30);
}

TEST(LightingTables, slopes_are_central_differences_across_each_kind_of_border) {
    TextureImage heights;
    heights.texels = Image<glm::vec4>(5, 3);
    for (std::size_t i = 0; i < heights.texels.pixels.size(); ++i)
        heights.texels.pixels[i].r = static_cast<float>((7 * i * i + 3 * i) % 11);
    for (const Wrap s : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const Wrap t : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
            heights.wrap_s = s;
            heights.wrap_t = t;
            EXPECT_EQ(expected_slopes(heights, 3).pixels, slopes_of(heights, 3).pixels);
        }
}

TEST(LightingTables, every_number_stands_for_the_same_normal) {
    for (int number = 0; number < 65536; ++number)
        ASSERT_LT(glm::distance(expected_normal(static_cast<std::uint16_t>(number)),
                                indexed_normal(static_cast<std::uint16_t>(number))),
                  1e-15)
            << number;
}

TEST(LightingTables, the_normalisation_cube_is_the_one_that_is_drawn_with) {
    for (const int size : {1, 2, 7, 64}) {
        const NormalisationCube drawn = make_normalisation_cube(size);
        const NormalisationCube expected = expected_normalisation_cube(size);
        for (std::size_t face = 0; face < drawn.faces.size(); ++face)
            EXPECT_EQ(expected.faces[face].pixels, drawn.faces[face].pixels);
    }
}

} // namespace
} // namespace shadowproof
