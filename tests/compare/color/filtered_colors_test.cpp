// Techniques that filter bump maps: each colour is predicted, by the level that the pixel's quad
// tells, and right is the mean over the pixel.
#include "compare/color/mean_check.h"
#include "tests/compare/color/judged_colors.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::checked_colors;
using tests::colors_of;
using tests::traced;
using tests::TracedScene;

constexpr std::array filtering{"bump_mipmapped", "bump_mipmapped_dimmed", "bump_toksvig",
                               "bump_lean"};

Scene sized(const std::string& name, int width, int height) {
    SceneRequest request;
    request.width = width;
    request.height = height;
    return load_scene(name, request);
}

void expect_predicted(const ColorCheck& colors) {
    EXPECT_EQ(colors.unpredicted, 0U)
        << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
    EXPECT_GT(colors.judged, 0U);
}

class FilteredColors : public testing::TestWithParam<const char*> {
protected:
    Gpu gpu_{GlPlatform::osmesa};
    const Technique& technique_ = *find_technique(GetParam());

    Frame drawn(const TracedScene& scene, const LightingSettings& settings = {}) {
        Plan plan = scene.plan;
        plan.asked.lighting = settings;
        return render(technique_, scene.scene, plan, gpu_);
    }
};

TEST_P(FilteredColors, are_predicted_with_any_number_of_lookups) {
    const TracedScene& scene = traced("distant_bumps", 256);
    for (const int anisotropy : {1, 2, 3, 7, 16}) {
        SCOPED_TRACE(anisotropy);
        expect_predicted(colors_of(scene, technique_, {.anisotropy = anisotropy}, gpu_));
    }
}

/// Quads pair columns from the left and rows from the bottom: at the border half of one is outside.
TEST_P(FilteredColors, are_predicted_in_pictures_of_odd_sizes) {
    for (const auto& [width, height] : {std::pair{161, 97}, std::pair{96, 255}, std::pair{1, 97}}) {
        SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
        const TracedScene scene(sized("distant_bumps", width, height));
        for (const int anisotropy : {1, 4})
            expect_predicted(colors_of(scene, technique_, {.anisotropy = anisotropy}, gpu_));
    }
}

/// Of those that do not ask for mipmaps: other wrap modes, mirrored mappings, heights in space, a
/// spot light, coarse triangles.
TEST_P(FilteredColors, are_predicted_on_every_scene_where_they_are_named) {
    for (const char* name : {"bumpy_torus", "mirrored_skin", "height_field", "stretched_relief",
                             "coarse_curve", "grazing_light", "fine_relief"}) {
        SCOPED_TRACE(name);
        const TracedScene& scene = traced(name, 160);
        for (const int anisotropy : {1, 4})
            expect_predicted(colors_of(scene, technique_, {.anisotropy = anisotropy}, gpu_));
    }
}

/// Levels of odd sizes, whose texels cover parts of others.
TEST_P(FilteredColors, are_predicted_of_maps_of_any_size) {
    Scene given = sized("distant_bumps", 160, 160);
    const std::array<glm::ivec2, 3> sizes{{{37, 21}, {1, 50}, {64, 5}}};
    for (std::size_t i = 0; i < given.textures.size(); ++i) {
        const Image<glm::vec4> old = given.textures[i].texels;
        const glm::ivec2 size = sizes.at(i % sizes.size());
        Image<glm::vec4>& texels = given.textures[i].texels;
        texels = Image<glm::vec4>(size.x, size.y);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                texels.at(x, y) = old.at(x % old.width, y % old.height);
        given.textures[i].wrap_s = i == 0 ? Wrap::mirrored_repeat : Wrap::clamp_to_edge;
    }
    const TracedScene scene(std::move(given));
    for (const int anisotropy : {1, 5})
        expect_predicted(colors_of(scene, technique_, {.anisotropy = anisotropy}, gpu_));
}

TEST_P(FilteredColors, are_predicted_through_a_geometry_shader_and_where_the_clipper_cuts) {
    Scene given = sized("distant_bumps", 200, 120);
    given.camera.near = 9.3; // amid the boards
    const TracedScene scene(std::move(given));
    const std::string joined = std::string(GetParam()) + "+zfail_geometry_shader";
    expect_predicted(
        checked_colors(scene, render(*find_technique(joined), scene.scene, scene.plan, gpu_)));
}

/// Matte surfaces, in shadow and not, whose slopes are anything: normals along the surface.
TEST_P(FilteredColors, of_matte_surfaces_with_normals_along_them_are_predicted) {
    Scene given = sized("distant_bumps", 160, 160);
    for (Material& material : given.materials) material.specular = glm::dvec3(0);
    for (TextureImage& texture : given.textures)
        for (std::size_t i = 0; i < texture.texels.pixels.size(); i += 5)
            texture.texels.pixels[i] =
                i % 2 == 0 ? glm::vec4(1, 0.5, 0.5, 1) : glm::vec4(0.5, 0, 0.25, 1);
    const TracedScene scene(std::move(given));
    for (const int anisotropy : {1, 4})
        expect_predicted(colors_of(scene, technique_, {.anisotropy = anisotropy}, gpu_));
}

TEST_P(FilteredColors, of_several_lights_are_predicted) {
    const Scene scene = tests::load_named("bumpy_lights-spot");
    const TracedScene lit(scene);
    const Frame frame = render(technique_, lit.scene, lit.plan, gpu_);
    expect_predicted(check_colors(lit.tracer, lit.truth, frame, lit.traced.lights_before(),
                                  &lit.traced.pixel_means()));
}

/// The prediction is narrow, but on the floor, which ends far beside the picture: half a step off,
/// no colour of the boards is explained any more.
TEST_P(FilteredColors, are_unexplained_half_a_step_off) {
    const TracedScene& scene = traced("distant_bumps", 256);
    Frame frame = drawn(scene);
    for (glm::vec3& color : frame.color.pixels)
        if (color != glm::vec3(0)) color += 0.5F / 255;
    const ColorCheck colors = checked_colors(scene, frame);
    int of_boards = 0;
    int excused = 0;
    for (std::size_t i = 0; i < colors.verdict.pixels.size(); ++i) {
        const ColorVerdict verdict = colors.verdict.pixels[i];
        if (verdict == ColorVerdict::as_shown) continue;
        const Mesh& mesh = scene.scene.meshes[mesh_of(scene.scene, frame.triangle.pixels[i])];
        if (!mesh.name.starts_with("board")) continue;
        ++of_boards;
        excused +=
            verdict == ColorVerdict::unpredicted || verdict == ColorVerdict::unexplained ? 0 : 1;
    }
    EXPECT_GT(of_boards, 5000);
    EXPECT_LT(excused, of_boards / 50);
}

/// What is drawn with another filter, or with more lookups, than it says, is found.
TEST_P(FilteredColors, of_another_filter_than_is_told_are_unexplained) {
    const TracedScene& scene = traced("distant_bumps", 256);
    const Frame frame = drawn(scene);
    for (const BumpFilter told :
         {BumpFilter::renormalised, BumpFilter::dimmed, BumpFilter::toksvig, BumpFilter::lean}) {
        if (told == frame.color_model.filter) continue;
        Frame other = frame;
        other.color_model.filter = told;
        EXPECT_GT(checked_colors(scene, other).unpredicted, 10000U) << name_of(told);
    }
    Frame other = frame;
    other.color_model.anisotropy = 2;
    EXPECT_GT(checked_colors(scene, other).unpredicted, 10000U);
}

/// Where texels are larger than pixels the centre stands for all of it; where they are not, what is
/// beyond a step of the mean is told to be the filter's doing.
TEST_P(FilteredColors, are_beyond_a_step_of_the_mean_by_what_the_filter_leaves_out) {
    const TracedScene& scene = traced("distant_bumps", 256);
    const ColorCheck colors = checked_colors(scene, drawn(scene));
    const std::uint64_t by_filter =
        colors.beyond_by[static_cast<std::size_t>(ColorTerm::filtering)];
    const std::uint64_t by_surroundings =
        colors.beyond_by[static_cast<std::size_t>(ColorTerm::surroundings)];
    EXPECT_GT(by_filter, colors.beyond / 2);
    EXPECT_GT(by_surroundings, 300U);
    EXPECT_NEAR(colors.bound_width.widest, 2, 1e-4); // 1/255 to either side of the mean
    EXPECT_EQ(colors.moved, 0U);
}

std::string name_of_tested(const testing::TestParamInfo<const char*>& tested) {
    return tested.param;
}
// Those whose highlights are their own; the others read the same mipmaps.
INSTANTIATE_TEST_SUITE_P(Telling, FilteredColors, testing::Values("bump_toksvig", "bump_lean"),
                         name_of_tested);
INSTANTIATE_TEST_SUITE_P(Long, FilteredColors,
                         testing::Values("bump_mipmapped", "bump_mipmapped_dimmed"),
                         name_of_tested);

TEST(MeanCheck, counts_each_pixel_once_by_texels_and_once_by_angle) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene& scene = traced("distant_bumps", 128);
    const Frame frame = render(*find_technique("bump_toksvig"), scene.scene, scene.plan, gpu);
    const ColorCheck colors = checked_colors(scene, frame);
    const PixelMeans& means = scene.traced.pixel_means();
    const MeanCheck& check = *colors.means;
    std::uint64_t alike = 0;
    std::uint64_t bumpy = 0;
    double squares = 0;
    for (std::size_t i = 0; i < means.color.pixels.size(); ++i) {
        if (colors.verdict.pixels[i] == ColorVerdict::as_shown) continue;
        const glm::dvec3 off = glm::dvec3(frame.color.pixels[i]) - means.color.pixels[i];
        squares += 255 * 255 * glm::dot(off, off);
        if (means.share_alike.pixels[i] < 1) continue;
        ++alike;
        bumpy += means.texels.pixels[i] > 0 ? 1 : 0;
    }
    EXPECT_EQ(check.alike, alike);
    EXPECT_NEAR(check.rmse, std::sqrt(squares / (3.0 * static_cast<double>(colors.judged))), 1e-9);
    EXPECT_NEAR(check.rmse, colors.rmse, 1e-9);
    EXPECT_EQ(check.most_rays, 32 * 32);
    for (const std::vector<ErrorBin>* bins : {&check.by_texels, &check.by_angle}) {
        std::uint64_t sum = 0;
        double last = -1;
        for (const ErrorBin& bin : *bins) {
            EXPECT_LT(last, bin.from + 1e-12);
            EXPECT_LT(bin.from, bin.to);
            last = bin.to - 1e-9;
            sum += bin.pixels;
        }
        EXPECT_EQ(sum, bumpy);
        EXPECT_GT(bins->size(), 6U);
    }
    EXPECT_LE(check.by_texels.front().from, 0.25);
    EXPECT_GE(check.by_texels.back().to, 128);
}

/// Averaging normals is not averaging reflections: where a pixel covers many bumps that are lit
/// alike, the mean normal keeps the diffuse light, if its length dims it, and makes highlights that
/// are none; what tells how normals vary comes closer.
class FlatBoard : public testing::Test {
protected:
    /// A board that faces the eye, `texels` of its bumps along a pixel.
    static Scene board(double texels, bool shiny) {
        Scene scene = sized("distant_bumps", 64, 64);
        for (Material& material : scene.materials) {
            material.decal = no_texture;
            material.gloss_in_alpha = false;
            material.specular = glm::dvec3(shiny ? 1 : 0);
            material.color = glm::dvec3(shiny ? 0 : 1);
            if (!shiny) material.bump_scale = 0.4; // so that all bumps face the light
        }
        scene.ambient = glm::dvec3(0);
        const Mesh first = scene.meshes[1]; // an upright board
        const std::uint32_t begin = first.first_triangle;
        scene.triangles = {scene.triangles.begin() + begin,
                           scene.triangles.begin() + begin + first.triangle_count};
        scene.surfaces = {scene.surfaces.begin() + 3 * begin,
                          scene.surfaces.begin() + 3 * (begin + first.triangle_count)};
        scene.meshes = {first};
        scene.meshes[0].first_triangle = 0;
        // The face towards +z, 0.782 wide, fills the picture.
        glm::dvec3 middle(0);
        for (const glm::uvec3& triangle : scene.triangles)
            for (int k = 0; k < 3; ++k)
                middle += glm::dvec3(scene.positions[triangle[k]]) /
                          (3.0 * static_cast<double>(scene.triangles.size()));
        scene.camera.eye = middle + glm::dvec3(0, 0, 2);
        scene.camera.right = {1, 0, 0};
        scene.camera.up = {0, 1, 0};
        scene.camera.forward = {0, 0, -1};
        scene.camera.half_height = 0.1;
        scene.lights[0].position = middle + glm::dvec3(-1.3, 1.7, 5);
        const double pixel = 2 * 0.1 * 2 / 64;
        const auto repeats = static_cast<float>(texels / 64 * 0.782 / pixel);
        for (Surface& surface : scene.surfaces)
            surface.bump_at = glm::sign(surface.bump_at) * repeats;
        return scene;
    }
    /// Its face turned to look along +z: both sides of a pixel cover as many texels.
    static Scene upright(double texels) {
        Scene scene = board(texels, true);
        const double lean = 0.213;
        const auto turned = [&](const glm::vec3& v) {
            const glm::dvec3 at(v);
            return glm::vec3(at.x, std::cos(lean) * at.y - std::sin(lean) * at.z,
                             std::sin(lean) * at.y + std::cos(lean) * at.z);
        };
        const glm::vec3 middle(scene.camera.eye - glm::dvec3(0, 0, 2));
        for (glm::vec3& position : scene.positions) position = middle + turned(position - middle);
        for (Surface& surface : scene.surfaces)
            surface.normal = glm::normalize(turned(surface.normal));
        return scene;
    }
    double rmse(double texels, bool shiny, const char* technique) {
        const TracedScene scene(board(texels, shiny));
        const Frame frame = render(*find_technique(technique), scene.scene, scene.plan, gpu_);
        const ColorCheck colors = checked_colors(scene, frame);
        EXPECT_EQ(colors.unpredicted, 0U) << technique;
        EXPECT_GT(colors.means->alike, 3000U) << technique;
        return colors.means->alike_rmse;
    }

    Gpu gpu_{GlPlatform::osmesa};
};

TEST_F(FlatBoard, keeps_its_diffuse_light_where_the_length_of_the_mean_normal_dims_it) {
    const double dimmed = rmse(64, false, "bump_mipmapped_dimmed");
    EXPECT_LT(dimmed, 1);
    EXPECT_GT(rmse(64, false, "bump_mipmapped"), 4 * dimmed);
}

TEST_F(FlatBoard, has_highlights_that_a_mean_normal_does_not_tell) {
    const double mean_normal = rmse(64, true, "bump_mipmapped");
    EXPECT_GT(mean_normal, 10);
    EXPECT_LT(rmse(64, true, "bump_toksvig"), mean_normal / 2);
    EXPECT_LT(rmse(64, true, "bump_lean"), mean_normal / 2);
}

/// There one lookup is as possible as two, along either side: each is predicted by itself, and what
/// lies between them is none.
TEST_F(FlatBoard, that_faces_the_eye_may_have_been_looked_up_once_or_twice_but_nothing_between) {
    const TracedScene scene(upright(8));
    for (const char* technique : filtering) {
        SCOPED_TRACE(technique);
        Plan plan = scene.plan;
        plan.asked.lighting.anisotropy = 2;
        Frame frame = render(*find_technique(technique), scene.scene, plan, gpu_);
        expect_predicted(checked_colors(scene, frame));
        for (glm::vec3& color : frame.color.pixels)
            if (color != glm::vec3(0)) color += 4.F / 255;
        const ColorCheck colors = checked_colors(scene, frame);
        EXPECT_GT(colors.unpredicted, colors.judged * 3 / 4);
    }
}

TEST_F(FlatBoard, is_right_with_any_where_texels_are_large) {
    EXPECT_LT(rmse(0.05, false, "bump_mipmapped"), 0.5);
    EXPECT_LT(rmse(0.05, false, "bump_mipmapped_dimmed"), 0.5);
    EXPECT_LT(rmse(0.05, true, "bump_mipmapped"), 0.5);
}

} // namespace
} // namespace shadowproof
