// What a technique's own arithmetic gives is predicted at every pixel: on all scenes, under all
// settings, on surfaces without bumps, with tangents that are none, where the clipper cuts, where
// floats end.
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "reference/shade/added_shader.h"
#include "tests/compare/color/judged_colors.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::checked_colors;
using tests::colors_of;
using tests::techniques_for;
using tests::traced;
using tests::TracedScene;

class ColorsOfScene : public testing::TestWithParam<std::string> {
protected:
    Gpu gpu_{GlPlatform::osmesa};
};

TEST_P(ColorsOfScene, every_pixel_of_every_technique_is_predicted_and_floats_are_within_a_step) {
    const TracedScene& scene = traced(GetParam(), 512);
    for (const Technique* technique : techniques_for(scene.scene)) {
        SCOPED_TRACE(technique->name);
        const Frame frame = render(*technique, scene.scene, scene.plan, gpu_);
        const ColorCheck colors = checked_colors(scene, frame);
        EXPECT_EQ(colors.unpredicted, 0U)
            << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
        // Joined techniques are wrong about most shadows on some of the scenes.
        const bool is_joined = technique->name.find('+') != std::string_view::npos;
        EXPECT_GT(colors.judged, is_joined ? 20000U : 100000U);
        if (!is_exact(frame.color_model, scene.scene)) {
            EXPECT_GT(colors.largest, is_joined ? 0.5 : 1);
            continue;
        }
        EXPECT_EQ(colors.beyond, 0U);
        // Where a pixel covers many texels, the little that snapping moves it is much of one.
        if (asks_for_mipmaps(scene.scene)) {
            EXPECT_LT(colors.moved, 100U);
            continue;
        }
        EXPECT_LT(colors.largest, 1) << "at " << colors.largest_x << "," << colors.largest_y;
        EXPECT_EQ(colors.moved, 0U);
        EXPECT_LE(colors.bound_width.widest, 2.001); // 1/255 to either side
    }
}

TEST_P(ColorsOfScene, every_pixel_is_predicted_under_every_setting) {
    const TracedScene& scene = traced(GetParam(), 160);
    const bool heights = std::ranges::none_of(scene.scene.materials, [](const Material& material) {
        return material.bump == Bump::normal_map;
    });
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

/// Each form of bumps, and a mapping that is no square.
constexpr std::array some_scenes{"bumpy_torus", "height_field", "skewed_relief"};

SHADOWPROOF_OVER_SOME_SCENES(ColorsOfScene, tests::bump_lit_scenes(), some_scenes);

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
            const ColorCheck colors = checked_colors(scene, frame);
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
            const ColorCheck colors = checked_colors(scene, frame);
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
/// a value interpolated between them is then that of a place beside the pixel. Each draw finds the
/// edge of a spot light's cone by such values itself, so that some pixels have light where the
/// claim has none: what is right a little aside.
TEST(Colors, of_triangles_that_the_clipper_cuts_are_predicted) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"coarse_curve", "bumpy_torus"})
        for (const float by : {1e2F, 1e6F, 1e7F, 1e8F, 1e9F, 0x1p54F}) {
            const TracedScene scene = stretched(name, by);
            for (const Technique* technique : techniques_for(scene.scene)) {
                SCOPED_TRACE(name + (", " + std::to_string(by)) + std::string(technique->name));
                const Frame frame = render(*technique, scene.scene, scene.plan, gpu);
                const ColorCheck colors = checked_colors(scene, frame);
                EXPECT_EQ(colors.unpredicted, 0U)
                    << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
                if (is_exact(frame.color_model, scene.scene)) {
                    EXPECT_EQ(colors.beyond, 0U);
                }
            }
        }
}

/// That is so at the cone's edge alone: light where a claim without a counter is dark inside of it
/// is unexplained.
TEST(Colors, that_are_lit_where_the_claim_is_dark_inside_a_cone_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("coarse_curve", 160);
    Frame frame = render(*find_technique("bump_eye_space"), scene.scene, scene.plan, gpu);
    frame.counted.reset();
    std::vector<SeenPoint> lit;
    std::vector<std::size_t> dark;
    for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i) {
        const std::uint32_t triangle = frame.triangle.pixels[i];
        if (frame.claim.pixels[i] != Visibility::shadowed || scene.truth.in_cone.pixels[i] == 0 ||
            triangle == no_triangle || !sides_of(scene.tracer, triangle).faces_light())
            continue;
        const auto x = static_cast<double>(i % 160);
        const auto y = static_cast<double>(i / 160);
        dark.push_back(i);
        lit.push_back({line_of_sight(scene.scene.camera, x + 0.5, y + 0.5), triangle, true});
    }
    std::vector<Shading> shadings(lit.size());
    AddedShader(scene.tracer, {}).shade(lit, shadings);
    std::uint64_t brighter = 0;
    for (std::size_t k = 0; k < dark.size(); ++k) {
        if (glm::length(shadings[k].added_color()) < 0.01) continue;
        frame.color.pixels[dark[k]] = shadings[k].color();
        ++brighter;
    }
    EXPECT_GT(brighter, 100U);
    EXPECT_EQ(checked_colors(scene, frame).unpredicted, brighter);
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
            const ColorCheck colors = checked_colors(scene, frame);
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
        const ColorCheck colors = checked_colors(scene, frame);
        EXPECT_EQ(colors.unpredicted, 0U);
        if (!is_exact(frame.color_model, scene.scene)) continue;
        EXPECT_EQ(colors.beyond, 0U);
        for (glm::vec3& color : frame.color.pixels) color.g += 0x1p-100F;
        EXPECT_GT(checked_colors(scene, frame).beyond, 500U);
    }
}

} // namespace
} // namespace shadowproof
