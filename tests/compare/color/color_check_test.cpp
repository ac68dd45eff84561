// Colours are judged by intervals that are derived, pixel by pixel: what a technique computes is
// predicted, what it rounds is within its bound, and what is not predicted is told.
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "compare/verdict.h"
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/faulty_lighting.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::TracedScene;

/// Kept for all tests that ask for it.
const TracedScene& traced(const std::string& name, int side) {
    static std::map<std::pair<std::string, int>, std::unique_ptr<TracedScene>> scenes;
    std::unique_ptr<TracedScene>& scene = scenes[{name, side}];
    if (!scene) {
        SceneRequest request;
        request.width = side;
        request.height = side;
        scene = std::make_unique<TracedScene>(load_scene(name, request));
    }
    return *scene;
}

std::vector<const Technique*> techniques_for(const Scene& scene) {
    std::vector<const Technique*> techniques;
    for (const Technique& technique : all_techniques())
        if (technique.needs_bump_maps && suits(technique, scene)) techniques.push_back(&technique);
    return techniques;
}

ColorCheck colors_of(const TracedScene& scene, const Technique& technique,
                     const LightingSettings& settings, Gpu& gpu) {
    Plan plan = scene.plan;
    plan.asked.lighting = settings;
    return check_colors(scene.tracer, scene.truth, render(technique, scene.scene, plan, gpu));
}

class ColorsOfScene : public testing::TestWithParam<std::string> {
protected:
    Gpu gpu_{GlPlatform::osmesa};
};

TEST_P(ColorsOfScene, every_pixel_of_every_technique_is_predicted_and_floats_are_within_a_step) {
    const TracedScene& scene = traced(GetParam(), 512);
    for (const Technique* technique : techniques_for(scene.scene)) {
        SCOPED_TRACE(technique->name);
        const Frame frame = render(*technique, scene.scene, scene.plan, gpu_);
        const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
        EXPECT_EQ(colors.unpredicted, 0U)
            << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
        // Joined techniques are wrong about most shadows on some of the scenes.
        const bool is_joined = technique->name.find('+') != std::string_view::npos;
        EXPECT_GT(colors.judged, is_joined ? 20000U : 100000U);
        if (!is_exact(frame.color_model, scene.scene)) {
            EXPECT_GT(colors.largest, is_joined ? 0.5 : 1);
            continue;
        }
        EXPECT_LT(colors.largest, 1) << "at " << colors.largest_x << "," << colors.largest_y;
        EXPECT_EQ(colors.beyond, 0U);
        EXPECT_EQ(colors.moved, 0U);
        EXPECT_LE(colors.bound_width.widest, 2.001); // 1/255 to either side
    }
}

TEST_P(ColorsOfScene, every_pixel_is_predicted_under_every_setting) {
    const TracedScene& scene = traced(GetParam(), 160);
    const bool heights =
        std::any_of(scene.scene.materials.begin(), scene.scene.materials.end(),
                    [](const Material& material) { return material.bump == Bump::height_field; });
    std::vector<LightingSettings> all;
    for (const Normalisation normalisation : all_normalisations)
        all.push_back({.normalisation = normalisation});
    for (const BumpForm form : all_bump_forms)
        if (form != BumpForm::height_field || heights) all.push_back({.bump_form = form});
    for (const VectorOrigin vectors : all_vector_origins)
        for (const TangentSource tangents : all_tangent_sources)
            all.push_back({.vectors = vectors, .tangents = tangents});
    for (const Technique* technique : techniques_for(scene.scene))
        for (const LightingSettings& settings : all) {
            SCOPED_TRACE(technique->name);
            SCOPED_TRACE(settings.vectors         ? name_of(*settings.vectors)
                         : settings.normalisation ? name_of(*settings.normalisation)
                                                  : name_of(*settings.bump_form));
            const ColorCheck colors = colors_of(scene, *technique, settings, gpu_);
            EXPECT_EQ(colors.unpredicted, 0U)
                << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
        }
}

INSTANTIATE_TEST_SUITE_P(BumpLit, ColorsOfScene, testing::ValuesIn(tests::bump_lit_scenes()),
                         [](const auto& instance) { return instance.param; });

/// Of a technique at its own settings on a bundled scene.
ColorCheck colors_of(const char* scene, const char* technique) {
    Gpu gpu(GlPlatform::osmesa);
    return colors_of(traced(scene, 256), *find_technique(technique), {}, gpu);
}

/// Every bump-mapped mesh becomes two, of which the second has no bumps, and so no tangents.
Scene half_smooth(Scene scene) {
    const std::vector<Mesh> given = std::exchange(scene.meshes, {});
    for (const Mesh& mesh : given) {
        scene.meshes.push_back(mesh);
        if (scene.materials[mesh.material].bump == Bump::none) continue;
        Mesh& rough = scene.meshes.back();
        rough.triangle_count /= 2;
        Mesh smooth = mesh;
        smooth.name += ", smooth";
        smooth.first_triangle += rough.triangle_count;
        smooth.triangle_count -= rough.triangle_count;
        smooth.material = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.push_back(scene.materials[mesh.material]);
        scene.materials.back().bump = Bump::none;
        for (std::uint32_t t = 0; t < smooth.triangle_count; ++t)
            for (std::size_t k = 0; k < 3; ++k)
                scene.surfaces[std::size_t{3} * (smooth.first_triangle + t) + k].tangent =
                    glm::vec4(0);
        scene.meshes.push_back(std::move(smooth));
    }
    return scene;
}

/// Such a surface has no tangents, and yet what its interpolated normals are off by counts for all
/// of the vectors to light and eye.
TEST(Colors, of_smooth_surfaces_beside_bumps_are_predicted) {
    Gpu gpu(GlPlatform::osmesa);
    for (const std::string& name : tests::bump_lit_scenes()) {
        SceneRequest request;
        request.width = request.height = 96;
        const TracedScene scene(half_smooth(load_scene(name, request)));
        for (const Technique* technique : techniques_for(scene.scene)) {
            SCOPED_TRACE(name + ", " + std::string(technique->name));
            const Frame frame = render(*technique, scene.scene, scene.plan, gpu);
            const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
            EXPECT_EQ(colors.unpredicted, 0U)
                << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
        }
    }
}

/// Tangents of an asset that run along its normals: what rounding leaves of them is no direction.
TEST(Colors, of_tangents_along_the_normals_are_predicted) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"bumpy_torus", "skewed_relief"}) {
        SceneRequest request;
        request.width = request.height = 96;
        Scene given = load_scene(name, request);
        for (Surface& surface : given.surfaces)
            if (surface.tangent != glm::vec4(0))
                surface.tangent = glm::vec4(surface.normal, surface.tangent.w);
        const TracedScene scene(std::move(given));
        for (const Technique* technique : techniques_for(scene.scene)) {
            SCOPED_TRACE(name + (", " + std::string(technique->name)));
            const Frame frame = render(*technique, scene.scene, scene.plan, gpu);
            const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
            EXPECT_EQ(colors.unpredicted, 0U)
                << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
        }
    }
}

/// With all that has bumps stretched along x.
TracedScene stretched(const std::string& name, float by) {
    SceneRequest request;
    request.width = request.height = 48;
    Scene scene = load_scene(name, request);
    std::vector<bool> bumpy(scene.positions.size());
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t t = 0; t < mesh.triangle_count; ++t)
            for (int k = 0; k < 3; ++k)
                if (scene.materials[mesh.material].bump != Bump::none)
                    bumpy[scene.triangles[mesh.first_triangle + t][k]] = true;
    for (std::size_t i = 0; i < bumpy.size(); ++i)
        if (bumpy[i]) scene.positions[i].x *= by;
    return TracedScene(std::move(scene));
}

/// The clipper makes corners from the triangle's, whose sizes decide how far the new ones are off:
/// a value interpolated between them is then that of a place beside the pixel.
TEST(Colors, of_triangles_that_the_clipper_cuts_are_predicted) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"coarse_curve", "bumpy_torus"})
        for (const float by : {1e2F, 1e6F, 1e7F, 1e8F, 1e9F, 0x1p54F}) {
            const TracedScene scene = stretched(name, by);
            for (const Technique* technique : techniques_for(scene.scene)) {
                SCOPED_TRACE(name + (", " + std::to_string(by)) + std::string(technique->name));
                const Frame frame = render(*technique, scene.scene, scene.plan, gpu);
                const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
                EXPECT_EQ(colors.unpredicted, 0U)
                    << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
            }
        }
}

/// Where the clipper's errors are small, they excuse little: of the rest the texels explain, of
/// which a pixel covers many.
TEST(Colors, of_triangles_that_the_clipper_cuts_are_unexplained_two_steps_off) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"coarse_curve", "bumpy_torus"}) {
        const TracedScene scene = stretched(name, 100);
        for (const char* technique : {"bump_tangent_space", "bump_eye_space"}) {
            Frame frame = render(*find_technique(technique), scene.scene, scene.plan, gpu);
            for (glm::vec3& color : frame.color.pixels) color += 2.F / 255;
            const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
            EXPECT_GT(colors.unpredicted, colors.judged / 2);
        }
    }
}

/// A driver flushes products to 0 that are too small for a float's exponent.
TEST(Colors, that_floats_do_not_hold_are_predicted) {
    Gpu gpu(GlPlatform::osmesa);
    SceneRequest request;
    request.width = request.height = 48;
    Scene given = load_scene("bumpy_sphere", request);
    for (Material& material : given.materials) material.color = {1e-40, 5e-324, 0.5};
    const TracedScene scene(std::move(given));
    for (const Technique* technique : techniques_for(scene.scene)) {
        SCOPED_TRACE(technique->name);
        Frame frame = render(*technique, scene.scene, scene.plan, gpu);
        const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
        EXPECT_EQ(colors.unpredicted, 0U);
        if (!is_exact(frame.color_model, scene.scene)) continue;
        EXPECT_EQ(colors.beyond, 0U);
        for (glm::vec3& color : frame.color.pixels) color.g += 0x1p-100F;
        EXPECT_GT(check_colors(scene.tracer, scene.truth, frame).beyond, 500U);
    }
}

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

/// What a pixel shows instead of its colour, in the channel 0.
ColorVerdict verdict_with(const TracedScene& scene, Frame frame, int x, int y, double red) {
    frame.color.at(x, y).r = static_cast<float>(red);
    return check_colors(scene.tracer, scene.truth, frame).verdict.at(x, y);
}

/// Of bytes and of floats, at a pixel in the light.
TEST(Colors, just_outside_of_the_bound_are_caught_and_just_inside_pass) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_sphere", 64);
    for (const char* name : {"bump_tangent_space", "bump_eye_space", "bump_three_pass"}) {
        SCOPED_TRACE(name);
        const Frame frame = render(*find_technique(name), scene.scene, scene.plan, gpu);
        int tried = 0;
        for (int y = 0; y < 64 && tried < 20; ++y)
            for (int x = y % 7; x < 64; x += 7) {
                const ColorAccount own = account_for_color(scene.tracer, scene.truth, frame, x, y);
                if (own.verdict != ColorVerdict::within || own.truth.diffuse < 0.1) continue;
                // Of a colour that is nowhere near, all that may be right is asked for.
                Frame red = frame;
                red.color.at(x, y).r = 5;
                const ColorAccount account =
                    account_for_color(scene.tracer, scene.truth, red, x, y);
                EXPECT_EQ(account.verdict, ColorVerdict::unexplained);
                const Interval& bound = account.bound[0];
                const Interval& predicted = account.predicted[0];
                const double low = std::max(bound.low, predicted.low);
                const double high = std::min(bound.high, predicted.high);
                constexpr double little = 0.001 / 255; // a thousandth of a step
                EXPECT_NE(verdict_with(scene, frame, x, y, high + little), ColorVerdict::within);
                EXPECT_NE(verdict_with(scene, frame, x, y, low - little), ColorVerdict::within);
                EXPECT_EQ(verdict_with(scene, frame, x, y, 0.5 * (low + high)),
                          ColorVerdict::within);
                ++tried;
            }
        EXPECT_GT(tried, 5);
    }
}

TEST(Colors, of_floats_that_are_off_by_two_steps_are_never_right) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"bumpy_sphere", "fine_relief", "height_field"}) {
        SCOPED_TRACE(name);
        const TracedScene& scene = traced(name, 128);
        for (const char* technique : {"bump_tangent_space", "bump_eye_space"}) {
            Frame frame = render(*find_technique(technique), scene.scene, scene.plan, gpu);
            for (glm::vec3& color : frame.color.pixels) color += 2.F / 255;
            const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
            EXPECT_EQ(std::count(colors.verdict.pixels.begin(), colors.verdict.pixels.end(),
                                 ColorVerdict::within),
                      0);
            EXPECT_GT(colors.unpredicted, colors.judged / 2);
        }
    }
}

TEST(Colors, of_the_background_are_black_and_the_least_number_else_is_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_sphere", 64);
    for (const char* name : {"bump_tangent_space", "bump_eye_space", "bump_three_pass"}) {
        SCOPED_TRACE(name);
        const Frame frame = render(*find_technique(name), scene.scene, scene.plan, gpu);
        std::uint64_t background = 0;
        for (std::size_t i = 0; i < frame.color.pixels.size(); ++i)
            if (frame.triangle.pixels[i] == no_triangle) ++background;
        EXPECT_GT(background, 100U);
        EXPECT_EQ(check_colors(scene.tracer, scene.truth, frame).unpredicted, 0U);
        for (const float red :
             {1.0F, 1 / 255.0F, std::numeric_limits<float>::denorm_min(),
              -std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::quiet_NaN()}) {
            Frame cleared = frame;
            for (std::size_t i = 0; i < cleared.color.pixels.size(); ++i)
                if (frame.triangle.pixels[i] == no_triangle) cleared.color.pixels[i].r = red;
            const Comparison comparison = tests::compared(scene, cleared);
            EXPECT_EQ(comparison.colors->unpredicted, background) << red;
            EXPECT_EQ(judge(scene.scene, {}, {}, comparison), Verdict::unexplained) << red;
        }
    }
}

/// The frame is right, and the truth it is judged by is not.
TEST(Colors, of_a_wrong_visibility_or_surface_are_those_of_what_is_shown) {
    Gpu gpu(GlPlatform::osmesa);
    SceneRequest request;
    request.width = request.height = 96;
    for (const char* name : {"bumpy_sphere", "coarse_curve", "height_field"}) {
        const TracedScene scene(load_scene(name, request));
        for (const Technique* technique : techniques_for(scene.scene)) {
            SCOPED_TRACE(name + (", " + std::string(technique->name)));
            const Frame right = render(*technique, scene.scene, scene.plan, gpu);
            GroundTruth other = scene.truth;
            std::uint64_t wrong = 0;
            for (std::size_t i = 0; i < other.visibility.pixels.size(); ++i) {
                Visibility& visibility = other.visibility.pixels[i];
                if (visibility == Visibility::background) continue;
                // In turns: a triangle that is not seen there, visibility, neither.
                if (i % 3 == 0) other.triangle.pixels[i] = other.triangle.pixels[i] == 0 ? 1 : 0;
                if (i % 3 == 1)
                    visibility =
                        visibility == Visibility::lit ? Visibility::shadowed : Visibility::lit;
                if (i % 3 != 2) ++wrong;
            }
            EXPECT_GT(wrong, 100U);
            const ColorCheck colors = check_colors(scene.tracer, other, right);
            EXPECT_EQ(colors.unpredicted, 0U);
            const auto as_shown = [&](const ColorCheck& check, std::size_t i) {
                return check.verdict.pixels[i] == ColorVerdict::as_shown;
            };
            Frame brighter = right;
            for (glm::vec3& color : brighter.color.pixels) color += 0.5F;
            const ColorCheck bright = check_colors(scene.tracer, other, brighter);
            for (std::size_t i = 0; i < other.visibility.pixels.size(); ++i) {
                if (other.visibility.pixels[i] == Visibility::background) continue;
                EXPECT_EQ(as_shown(colors, i), i % 3 != 2) << i;
                EXPECT_FALSE(as_shown(bright, i)) << i;
            }
        }
    }
}

/// A pixel that claims light must be lit, and one that claims shadow must not.
TEST(Colors, of_the_other_visibility_than_is_claimed_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_sphere", 64);
    for (const char* name : {"bump_tangent_space", "bump_three_pass"}) {
        SCOPED_TRACE(name);
        Frame frame = render(*find_technique(name), scene.scene, scene.plan, gpu);
        for (Visibility& claim : frame.claim.pixels)
            if (claim == Visibility::lit) claim = Visibility::shadowed;
        const ColorCheck colors = check_colors(scene.tracer, scene.truth, frame);
        int bright = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                if (scene.truth.visibility.at(x, y) != Visibility::lit) continue;
                const ColorAccount account =
                    account_for_color(scene.tracer, scene.truth, frame, x, y);
                EXPECT_EQ(account.verdict, colors.verdict.at(x, y));
                if (account.truth.diffuse < 0.1) continue;
                ++bright;
                EXPECT_EQ(account.verdict, ColorVerdict::unexplained) << x << ' ' << y;
            }
        EXPECT_GT(bright, 100);
    }
}

TEST(Colors, tell_how_wide_their_bounds_are_and_which_needed_the_rasterizers_spread) {
    const ColorCheck floats = colors_of("bumpy_torus", "bump_tangent_space");
    const ColorCheck bytes = colors_of("bumpy_torus", "bump_one_pass");
    EXPECT_LT(floats.bound_width.median, 0.01); // nothing but the roundings of floats
    EXPECT_LE(floats.bound_width.widest, 2.001);
    EXPECT_GT(bytes.bound_width.median, 1); // half a step to either side at the least
    EXPECT_LT(bytes.bound_width.median, bytes.bound_width.percentile999);
    EXPECT_LE(bytes.bound_width.percentile999, bytes.bound_width.widest);
    EXPECT_GT(floats.interpolated, 0U);
    EXPECT_LT(floats.interpolated, floats.judged / 4);
}

TEST(Colors, are_the_same_for_any_number_of_threads) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("bumpy_torus", 256);
    const Frame frame = render(*find_technique("bump_one_pass"), scene.scene, scene.plan, gpu);
    const ColorCheck many = check_colors(scene.tracer, scene.truth, frame);
    const Tracer tracer(scene.scene, 1);
    const ColorCheck one = check_colors(tracer, scene.truth, frame);
    EXPECT_EQ(one.error.pixels, many.error.pixels);
    EXPECT_EQ(one.verdict.pixels, many.verdict.pixels);
    EXPECT_EQ(one.rmse, many.rmse);
    EXPECT_EQ(one.beyond_by, many.beyond_by);
    EXPECT_EQ(one.interpolated, many.interpolated);
}

class FaultInLighting : public testing::TestWithParam<tests::LightingFault> {};

/// Its right twin is predicted to the last pixel (ColorsOfScene).
TEST_P(FaultInLighting, is_caught_on_a_bundled_scene) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced(GetParam().scene, 256);
    const Comparison comparison =
        tests::compared(scene, tests::draw_faulty(gpu, scene.scene, scene.plan, GetParam()));
    EXPECT_GT(comparison.colors->unpredicted, 100U);
    EXPECT_EQ(judge(scene.scene, {}, {}, comparison), Verdict::unexplained);
}

INSTANTIATE_TEST_SUITE_P(Injected, FaultInLighting,
                         testing::ValuesIn(tests::lighting_faults().begin(),
                                           tests::lighting_faults().end()),
                         [](const auto& fault) { return std::string(fault.param.name); });

} // namespace
} // namespace shadowproof
