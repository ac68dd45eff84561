// Where a technique computes something else than the truth its colours are shading, predicted, and
// those of a technique that computes otherwise than it says are unexplained.
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "tests/compare/color/judged_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace shadowproof {
namespace {

using tests::colors_of;
using tests::techniques_for;
using tests::traced;
using tests::TracedScene;

/// The three passes dim highlights by the half-angle vector's self-shadowing in place of the
/// light's, the one pass by both.
TEST(Colors, three_passes_leave_highlights_bright_near_the_terminator_and_one_pass_dims_them) {
    EXPECT_GT(colors_of("terminator_highlight", "bump_three_pass").beyond, 1000U);
    EXPECT_EQ(colors_of("terminator_highlight", "bump_one_pass").beyond, 0U);
}

/// Whichever reading a file asks for, what has it is right, and what has not is `shading` at most.
TEST(Colors, under_each_reading_of_the_rule_are_right_where_a_technique_has_that_reading) {
    Gpu gpu(GlPlatform::osmesa);
    for (const HighlightShadow shadow : all_highlight_shadows)
        for (const int squarings : {0, 3, largest_squarings}) {
            SCOPED_TRACE(std::string(name_of(shadow)) + ", " + std::to_string(squarings));
            SceneRequest request;
            request.width = request.height = 96;
            Scene given = load_scene("terminator_highlight", request);
            given.highlight = {shadow, squarings};
            const TracedScene scene(std::move(given));
            const auto colors = [&](const char* name) {
                return check_colors(scene.tracer, scene.truth,
                                    render(*find_technique(name), scene.scene, scene.plan, gpu));
            };
            for (const char* name : {"bump_tangent_space", "bump_eye_space"}) {
                const ColorCheck floats = colors(name);
                EXPECT_EQ(floats.unpredicted + floats.beyond, 0U) << name;
            }
            const ColorCheck passes = colors("bump_three_pass_per_pixel");
            EXPECT_EQ(passes.unpredicted, 0U);
            if (shadow == HighlightShadow::half_angle) {
                EXPECT_EQ(passes.beyond, 0U);
            }
            if (squarings == 3) {
                const ColorCheck three = colors("bump_three_pass");
                EXPECT_EQ(three.unpredicted, 0U);
                if (shadow == HighlightShadow::half_angle) {
                    EXPECT_EQ(three.beyond, 0U);
                }
                const ColorCheck one = colors("bump_one_pass");
                EXPECT_EQ(one.unpredicted, 0U);
                if (shadow == HighlightShadow::half_angle) {
                    EXPECT_GT(one.beyond, 100U);
                }
            } else {
                EXPECT_FALSE(suits(*find_technique("bump_one_pass"), scene.scene));
                EXPECT_FALSE(suits(*find_technique("bump_three_pass"), scene.scene));
            }
        }
}

/// A technique that drew by another reading, or with another exponent, than the file asks for.
TEST(Colors, of_another_reading_than_the_files_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("terminator_highlight", 96);
    for (const Highlight other :
         {Highlight{HighlightShadow::half_angle, 3}, Highlight{HighlightShadow::none, 3},
          Highlight{HighlightShadow::light, 2}, Highlight{HighlightShadow::light, 4}}) {
        Scene drawn = scene.scene;
        drawn.highlight = other;
        const Frame frame = render(*find_technique("bump_tangent_space"), drawn, scene.plan, gpu);
        EXPECT_GT(check_colors(scene.tracer, scene.truth, frame).unpredicted, 100U)
            << name_of(other.shadow) << ", " << other.exponent();
    }
}

/// Heights in units of space: Blinn's formula knows how long a texel is and which way its sides
/// run. A normal map, and slopes in tangent space, take all for squares of one size.
TEST(Colors, of_stretched_and_skewed_texels_are_right_by_parametric_derivatives_alone) {
    for (const char* name : {"stretched_relief", "skewed_relief"}) {
        const ColorCheck blinn = colors_of(name, "bump_eye_space");
        EXPECT_EQ(blinn.unpredicted + blinn.beyond + blinn.moved, 0U) << name;
        EXPECT_LT(blinn.largest, 0.1) << name;
        for (const char* other : {"bump_tangent_space", "bump_three_pass", "bump_one_pass"}) {
            const ColorCheck colors = colors_of(name, other);
            EXPECT_EQ(colors.unpredicted, 0U) << name << ", " << other;
            EXPECT_GT(colors.beyond, 3000U) << name << ", " << other;
            EXPECT_GT(colors.largest, 90) << name << ", " << other;
            EXPECT_GT(colors.beyond_by[static_cast<std::size_t>(ColorTerm::bump_form)],
                      colors.beyond / 2)
                << name << ", " << other;
        }
    }
}

/// One that drew heights half a percent too high, or heights of texels.
TEST(Colors, of_other_heights_over_stretched_texels_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"stretched_relief", "skewed_relief"}) {
        const TracedScene& scene = traced(name, 256);
        for (const double factor : {1.005, 0.995}) {
            Scene drawn = scene.scene;
            for (Material& material : drawn.materials) material.bump_scale *= factor;
            const Frame frame = render(*find_technique("bump_eye_space"), drawn, scene.plan, gpu);
            EXPECT_GT(check_colors(scene.tracer, scene.truth, frame).unpredicted, 300U) << name;
        }
        Scene drawn = scene.scene;
        for (Material& material : drawn.materials) {
            if (!material.height_in_space) continue;
            material.bump_scale *= 58; // as many texels to a unit, on average
            material.height_in_space = false;
        }
        const Frame frame = render(*find_technique("bump_eye_space"), drawn, scene.plan, gpu);
        EXPECT_GT(check_colors(scene.tracer, scene.truth, frame).unpredicted, 300U) << name;
    }
}

/// A technique that made its vectors otherwise, or by other tangents, than it says.
TEST(Colors, of_vectors_that_are_made_elsewhere_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("coarse_curve", 256);
    for (const char* name : {"bump_tangent_space", "bump_three_pass", "bump_one_pass"})
        for (const VectorOrigin drawn : all_vector_origins)
            for (const TangentSource tangents : all_tangent_sources) {
                Plan plan = scene.plan;
                plan.asked.lighting = {.vectors = drawn, .tangents = tangents};
                Frame frame = render(*find_technique(name), scene.scene, plan, gpu);
                for (const VectorOrigin told : all_vector_origins) {
                    // What two lengths at the vertices differ by here is less than bytes and cube
                    // map leave open.
                    const bool alike = told != VectorOrigin::per_pixel &&
                                       drawn != VectorOrigin::per_pixel &&
                                       name != std::string_view("bump_tangent_space");
                    if (told == drawn || alike) continue;
                    frame.color_model.vectors = told;
                    EXPECT_GT(check_colors(scene.tracer, scene.truth, frame).unpredicted, 300U)
                        << name << ", " << name_of(drawn) << " told as " << name_of(told);
                }
                frame.color_model.vectors = drawn;
                frame.color_model.tangents = tangents == TangentSource::vertices
                                                 ? TangentSource::polygons
                                                 : TangentSource::vertices;
                EXPECT_GT(check_colors(scene.tracer, scene.truth, frame).unpredicted, 300U)
                    << name << ", " << name_of(drawn) << ", tangents not of " << name_of(tangents);
            }
}

/// L of any length is linear over a flat triangle, so that nothing is lost by interpolating it;
/// once it is normalised at the vertices, it is not.
TEST(Colors, of_a_flat_floor_without_highlights_lose_nothing_between_vertices_until_normalised) {
    Gpu gpu(GlPlatform::osmesa);
    SceneRequest request;
    request.width = request.height = 128;
    Scene given = load_scene("height_field", request);
    for (Material& material : given.materials) material.specular = glm::dvec3(0);
    const TracedScene scene(std::move(given));
    const auto largest = [&](VectorOrigin vectors) {
        return colors_of(scene, *find_technique("bump_tangent_space"), {.vectors = vectors}, gpu)
            .largest;
    };
    EXPECT_LT(largest(VectorOrigin::per_pixel), 0.1);
    EXPECT_LT(largest(VectorOrigin::at_vertices), 0.1);
    EXPECT_GT(largest(VectorOrigin::unit_at_vertices), 1);
}

TEST(Colors, three_passes_clamp_bright_light_before_the_decal_and_one_pass_hardly_does) {
    const ColorCheck three = colors_of("bright_light", "bump_three_pass");
    const ColorCheck one = colors_of("bright_light", "bump_one_pass");
    EXPECT_GT(three.beyond, 100 * one.beyond);
}

TEST(Colors, a_pixel_of_the_terminator_owes_most_of_its_difference_to_the_undimmed_highlight) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("terminator_highlight", 256);
    const Frame frame = render(*find_technique("bump_three_pass"), scene.scene, scene.plan, gpu);
    const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
    const ColorAccount account =
        account_for_color(scene.tracer, scene.truth, frame, colors.largest_x, colors.largest_y);
    EXPECT_EQ(account.verdict, ColorVerdict::beyond);
    const auto heaviest = std::max_element(account.weights.begin(), account.weights.end());
    EXPECT_EQ(heaviest - account.weights.begin(),
              static_cast<std::ptrdiff_t>(ColorTerm::self_shadow));
}

/// Mixing unit normals leaves them shorter where they point apart: by as much as this
/// relief is steep. Its bound held that once, as it was the hull with the technique's own bumps.
TEST(Colors, of_a_normal_that_mixing_leaves_too_short_are_shading) {
    const ColorCheck colors = colors_of("height_field", "bump_one_pass");
    EXPECT_GT(colors.largest, 100);
    EXPECT_EQ(colors.verdict.at(colors.largest_x, colors.largest_y), ColorVerdict::beyond);
    EXPECT_EQ(colors.unpredicted, 0U);
    const auto by = std::max_element(colors.beyond_by.begin(), colors.beyond_by.end());
    EXPECT_EQ(by - colors.beyond_by.begin(), static_cast<std::ptrdiff_t>(ColorTerm::bump_length));
}

} // namespace
} // namespace shadowproof
