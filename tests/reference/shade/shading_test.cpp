#include "reference/shade/shading.h"
#include "scenes/load/catalog.h"
#include "scenes/scaling.h"
#include "tests/reference/hard_scenes.h"
#include "tests/reference/shading_witness.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace shadowproof {
namespace {

// Some hundred roundings of numbers near 1, and slopes of up to a few hundred texels a unit.
constexpr double rounding = 1e-11;

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double within = rounding) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], within);
}

Scene picture_of(const std::string& name, int width, int height) {
    SceneRequest request;
    request.width = width;
    request.height = height;
    return load_scene(name, request);
}

/// A wall at z = -2 that fills the picture of 8 x 8 pixels; the eye at the origin looks at it.
/// Tangents run along x, the picture on it is upright. One texel of normal map.
Scene wall(const glm::dvec3& texel_normal) {
    Scene scene = empty_scene(8);
    add_triangle(scene, {-8, -8, -2}, {8, -8, -2}, {8, 8, -2});
    add_triangle(scene, {-8, -8, -2}, {8, 8, -2}, {-8, 8, -2});
    finish(scene, true);
    TextureImage map;
    map.texels = Image<glm::vec4>(1, 1, glm::vec4(glm::vec3(texel_normal * 0.5 + 0.5), 1));
    scene.textures = {map};
    scene.materials[0].bump = Bump::normal_map;
    scene.materials[0].bump_map = 0;
    for (const glm::uvec3& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 place = scene.positions[triangle[k]];
            scene.surfaces.push_back(
                {{0, 0, 1}, {1, 0, 0, 1}, {place.x, -place.y}, {place.x, -place.y}});
        }
    scene.lights[0].position = {1, 2, 0};
    return scene;
}

/// Of the wall at a pixel.
glm::dvec3 wall_point(int x, int y) {
    return {2 * ((2 * x + 1) / 8.0 - 1), 2 * (1 - (2 * y + 1) / 8.0), -2};
}

TEST(shading, of_a_wall_with_one_small_normal_all_over_has_a_closed_form) {
    const glm::dvec3 n(0.25, -0.125, 1); // of any length; exact in a texel but for 0.5 + 0.5
    Scene scene = wall(n);
    scene.materials[0].color = {0.5, 0.25, 1};
    scene.materials[0].specular = {0.75, 1, 0.5};
    scene.lights[0].color = {1, 0.5, 0.25};
    scene.ambient = {0.125, 0.25, 0.5};
    const Tracer tracer(scene);
    const Image<glm::dvec3> shaded = shade(tracer, trace(tracer));
    const glm::dvec3 bumped = glm::normalize(n);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const glm::dvec3 p = wall_point(x, y);
            const glm::dvec3 l = glm::normalize(glm::dvec3(1, 2, 0) - p);
            const glm::dvec3 h = glm::normalize(l - glm::normalize(p));
            const double diffuse = std::min(1.0, 8 * l.z) * std::max(0.0, glm::dot(l, bumped));
            const double specular =
                std::min(1.0, 8 * h.z) * std::pow(std::max(0.0, glm::dot(h, bumped)), 8);
            expect_near(shaded.at(x, y),
                        (scene.lights[0].color * diffuse + scene.ambient) *
                                scene.materials[0].color +
                            scene.lights[0].color * specular * scene.materials[0].specular);
        }
}

TEST(shading, takes_a_normal_maps_x_to_the_right_and_its_y_up_the_picture) {
    const auto bumped = [](const glm::dvec3& texel) {
        const Scene scene = wall(texel);
        return shade_ray(Tracer(scene), {0.0625, 0.0625, -1})->bumped;
    };
    expect_near(bumped({1, 0, 0}), {1, 0, 0});
    expect_near(bumped({0, 1, 0}), {0, 1, 0});
    Scene mirrored = wall({0, 1, 0});
    for (Surface& surface : mirrored.surfaces) surface.tangent.w = -1;
    expect_near(shade_ray(Tracer(mirrored), {0.0625, 0.0625, -1})->bumped, {0, -1, 0});
}

TEST(shading, of_the_back_of_a_surface_has_its_normals_turned_round) {
    Scene scene = wall({0.6, 0, 0.8});
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.y, triangle.z);
    for (std::size_t i = 0; i < scene.surfaces.size(); i += 3)
        std::swap(scene.surfaces[i + 1], scene.surfaces[i + 2]);
    const auto seen = shade_ray(Tracer(scene), {0.0625, 0.0625, -1});
    expect_near(seen->normal, {0, 0, -1});
    // The bitangent was to point up on the front, whose normal is now -z; from behind both turn.
    expect_near(seen->bumped, glm::dvec3(-0.6, 0, -0.8), 1e-7); // 0.6 is rounded to float
}

TEST(shading, fades_out_as_the_light_comes_to_graze_the_surface) {
    Scene scene = wall({0, 0, 1});
    scene.lights[0].kind = Light::Kind::directional;
    for (const double height : {0.0625, 0.25}) { // half of 1 / 8, and past it
        scene.lights[0].direction = -glm::dvec3(std::sqrt(1 - height * height), 0, height);
        const auto seen = shade_ray(Tracer(scene), {0.0625, 0.0625, -1});
        EXPECT_NEAR(seen->self_shadow_light, std::min(1.0, 8 * height), rounding);
        EXPECT_NEAR(seen->diffuse, std::min(1.0, 8 * height) * height, rounding);
    }
}

TEST(shading, by_a_spot_falls_off_between_its_cones_as_khr_lights_punctual_has_it) {
    Scene scene = wall({0, 0, 1});
    scene.lights[0].kind = Light::Kind::spot;
    scene.lights[0].position = {0, 0, 0};
    scene.lights[0].direction = {0, 0, -1};
    scene.lights[0].inner_cone = std::atan(0.25);
    scene.lights[0].outer_cone = std::atan(0.75);
    const Tracer tracer(scene);
    const auto strength = [&](double tangent) {
        return shade_ray(tracer, {tangent, 0.03125, -1})->light.x;
    };
    EXPECT_EQ(strength(0.125), 1);
    const double cosine = 1 / std::sqrt(1 + 0.25 + 0.03125 * 0.03125);
    const double inner = 1 / std::sqrt(1 + 0.0625);
    const double outer = 1 / std::sqrt(1 + 0.5625);
    EXPECT_NEAR(strength(0.5), std::pow((cosine - outer) / (inner - outer), 2), rounding);
    EXPECT_EQ(strength(0.875), 0);
}

TEST(shading, counts_distance_and_intensity_only_where_the_scene_asks_for_them) {
    Scene scene = wall({0, 0, 1});
    scene.lights[0].intensity = 18;
    const glm::dvec3 direction(0.125, 0.375, -1); // to (0.25, 0.75, -2)
    const double square = 0.75 * 0.75 + 1.25 * 1.25 + 4;
    expect_near(shade_ray(Tracer(scene), direction)->light, glm::dvec3(1));
    scene.inverse_square = true;
    expect_near(shade_ray(Tracer(scene), direction)->light, glm::dvec3(18 / square));
    scene.lights[0].kind = Light::Kind::directional;
    expect_near(shade_ray(Tracer(scene), direction)->light, glm::dvec3(18));
}

TEST(shading, of_a_decal_multiplies_diffuse_and_ambient_and_its_alpha_the_highlight) {
    Scene scene = wall({0, 0, 1});
    TextureImage decal;
    decal.texels = Image<glm::vec4>(1, 1, glm::vec4(0.5F, 0.25F, 1, 0.125F));
    scene.textures.push_back(decal);
    scene.ambient = glm::dvec3(0.5);
    const glm::dvec3 direction(0.125, 0.375, -1);
    const Shading plain = *shade_ray(Tracer(scene), direction);
    scene.materials[0].decal = 1;
    const Shading dull = *shade_ray(Tracer(scene), direction);
    scene.materials[0].gloss_in_alpha = true;
    const Shading glossy = *shade_ray(Tracer(scene), direction);
    expect_near(dull.diffuse_color, plain.diffuse_color * glm::dvec3(0.5, 0.25, 1));
    expect_near(dull.ambient_color, glm::dvec3(0.25, 0.125, 0.5));
    expect_near(dull.specular_color, plain.specular_color);
    EXPECT_GT(plain.specular_color.x, 0.1);
    expect_near(glossy.specular_color, plain.specular_color * 0.125);
}

/// Heights that rise by 1/16 to the right and 1/32 down the picture, a texel.
TextureImage even_slope() {
    TextureImage map;
    map.texels = Image<glm::vec4>(8, 8);
    map.wrap_s = map.wrap_t = Wrap::clamp_to_edge;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            map.texels.at(x, y) =
                glm::vec4(static_cast<float>(x) / 16 + static_cast<float>(y) / 32);
    return map;
}

TEST(shading, of_a_height_field_that_rises_evenly_leans_as_its_slope_does) {
    Scene scene = wall({0, 0, 1});
    scene.materials[0].bump = Bump::height_field;
    scene.materials[0].bump_scale = 2;
    scene.textures[0] = even_slope();
    for (Surface& surface : scene.surfaces) surface.bump_at = {0.5F, 0.5F};
    const auto seen = shade_ray(Tracer(scene), {0.0625, 0.0625, -1});
    expect_near(seen->bumped, glm::normalize(glm::dvec3(-2.0 / 16, 2.0 / 32, 1)));
}

/// Of heights in units of space the slope is over the way that texels make, not their number: a
/// wall whose picture is four times as wide as high, and one that leans.
TEST(shading, of_heights_in_space_is_less_steep_where_a_texel_is_longer) {
    Scene scene = wall({0, 0, 1});
    scene.materials[0] = {
        .name = "relief", .bump = Bump::height_field, .bump_map = 0, .height_in_space = true};
    scene.textures[0] = even_slope();
    const auto bumped_over = [&](const glm::dvec2& across, const glm::dvec2& down) {
        // Texture coordinates of a place, of sides that are `across` and `down` long.
        const glm::dmat2 sides(across, down);
        for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
            const auto triangle = static_cast<std::uint32_t>(i / 3);
            const glm::dvec3 place = corner(scene, triangle, static_cast<int>(i % 3));
            scene.surfaces[i].bump_at =
                glm::dvec2(0.5) + glm::inverse(sides) * glm::dvec2(place) / 8.0;
        }
        return shade_ray(Tracer(scene), {0.0625, 0.0625, -1})->bumped;
    };
    expect_near(bumped_over({1, 0}, {0, -1}), glm::normalize(glm::dvec3(-1.0 / 16, 1.0 / 32, 1)));
    expect_near(bumped_over({4, 0}, {0, -1}), glm::normalize(glm::dvec3(-1.0 / 64, 1.0 / 32, 1)));
    // Down and a texel to the right: of what it rises on the way, the way to the right has its
    // part.
    expect_near(bumped_over({1, 0}, {1, -1}),
                glm::normalize(glm::dvec3(-1.0 / 16, 1.0 / 32 - 1.0 / 16, 1)));
    // Mirrored.
    expect_near(bumped_over({-1, 0}, {0, -1}), glm::normalize(glm::dvec3(1.0 / 16, 1.0 / 32, 1)));
}

/// Heights in units of space grow with the scene.
TEST(shading, of_a_scene_scaled_by_a_power_of_two_stays_the_same) {
    for (const char* name : {"stretched_relief", "height_field"}) {
        const Scene scene = picture_of(name, 48, 48);
        Scene larger = scene;
        scale(larger, 1024);
        const auto colors_of = [](const Scene& given) {
            const Tracer tracer(given);
            return shade(tracer, trace(tracer));
        };
        EXPECT_EQ(colors_of(scene).pixels, colors_of(larger).pixels) << name;
    }
}

TEST(shading, leaves_ambient_alone_in_shadow_and_nothing_at_background) {
    Scene scene = picture_of("bumpy_sphere", 96, 96);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const Image<Shading> shaded = shade_terms(tracer, truth);
    int shadowed = 0;
    int background = 0;
    for (std::size_t i = 0; i < shaded.pixels.size(); ++i) {
        const Shading& pixel = shaded.pixels[i];
        if (truth.visibility.pixels[i] == Visibility::background) {
            EXPECT_EQ(pixel.color(), glm::dvec3(0));
            ++background;
        } else if (truth.visibility.pixels[i] == Visibility::shadowed) {
            EXPECT_EQ(pixel.color(), scene.ambient * pixel.decal);
            ++shadowed;
        } else {
            EXPECT_TRUE(pixel.lit);
        }
    }
    EXPECT_GT(shadowed, 100);
    EXPECT_GT(background, 100);
}

TEST(shading, lights_what_receives_no_shadows_wherever_it_faces_the_light) {
    Scene scene = picture_of("bumpy_sphere", 96, 96);
    for (Mesh& mesh : scene.meshes) mesh.receives = false;
    const Tracer tracer(scene);
    const Image<Shading> shaded = shade_terms(tracer, trace(tracer));
    const auto lit = [](const Shading& pixel) { return pixel.lit; };
    const auto with = std::count_if(shaded.pixels.begin(), shaded.pixels.end(), lit);
    for (Mesh& mesh : scene.meshes) mesh.receives = true;
    const Tracer receiving(scene);
    const Image<Shading> under = shade_terms(receiving, trace(receiving));
    EXPECT_GT(with, std::count_if(under.pixels.begin(), under.pixels.end(), lit) + 100);
}

/// The bundled scenes that are lit by bump maps, and the square of their pictures.
constexpr int side = 192;
std::vector<Scene> pictures_lit_by_bumps() {
    std::vector<Scene> scenes;
    for (const std::string& name : tests::bump_lit_scenes())
        scenes.push_back(picture_of(name, side, side));
    return scenes;
}

/// The largest difference between the truth and the witness with a fault, on colours that a screen
/// can show.
double difference_by(const Scene& scene, witness::Fault fault) {
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const Image<glm::dvec3> shaded = shade(tracer, truth);
    double largest = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            if (truth.triangle.at(x, y) == no_triangle) continue;
            const glm::dvec3 expected = witness::color_at(
                scene, line_of_sight(scene.camera, x + 0.5, y + 0.5), truth.triangle.at(x, y),
                truth.visibility.at(x, y) == Visibility::lit, fault);
            const glm::dvec3 off =
                glm::abs(glm::clamp(expected, 0.0, 1.0) - glm::clamp(shaded.at(x, y), 0.0, 1.0));
            largest = std::max({largest, off.x, off.y, off.z});
        }
    return largest;
}

/// Places are rounded as shares of the texture: the more texels these are over, the more of one.
double rounding_on(const Scene& scene) {
    double most = 0; // texels
    for (const Surface& surface : scene.surfaces)
        for (const TextureImage& texture : scene.textures) {
            const glm::dvec2 size(texture.texels.width, texture.texels.height);
            const glm::dvec2 bump = glm::abs(glm::dvec2(surface.bump_at)) * size;
            const glm::dvec2 decal = glm::abs(glm::dvec2(surface.decal_at)) * size;
            most = std::max({most, bump.x, bump.y, decal.x, decal.y});
        }
    constexpr double few_hundred = 500;
    return rounding * std::max(1.0, most / few_hundred);
}

TEST(shading, of_the_bundled_scenes_equals_the_witness_at_every_pixel) {
    const std::vector<Scene> scenes = pictures_lit_by_bumps();
    ASSERT_GE(scenes.size(), 4U);
    for (const Scene& scene : scenes)
        EXPECT_LT(difference_by(scene, witness::Fault::none), rounding_on(scene)) << scene.name;
}

TEST(shading, under_each_reading_of_the_rule_equals_the_witness) {
    for (Scene& scene : pictures_lit_by_bumps())
        for (const HighlightShadow shadow : all_highlight_shadows)
            for (const int squarings : {0, 2, 3, largest_squarings}) {
                scene.highlight = {shadow, squarings};
                EXPECT_LT(difference_by(scene, witness::Fault::none), rounding_on(scene))
                    << scene.name << ", " << name_of(shadow) << ", " << scene.highlight.exponent();
            }
}

class FaultyLighting : public testing::TestWithParam<witness::Fault> {};

TEST_P(FaultyLighting, shows_on_a_bundled_scene) {
    double largest = 0;
    for (const Scene& scene : pictures_lit_by_bumps())
        largest = std::max(largest, difference_by(scene, GetParam()));
    EXPECT_GT(largest, 4 / 255.0); // far beyond one step of 8 bits
}

INSTANTIATE_TEST_SUITE_P(Reference, FaultyLighting, testing::ValuesIn(witness::all_faults),
                         [](const auto& fault) { return witness::name_of(fault.param); });

TEST(shading, has_the_same_bits_for_any_number_of_threads_and_any_instruction_set) {
    const Scene scene = picture_of("bumpy_torus", side, side);
    const auto all = [&](int threads) {
        const Tracer tracer(scene, threads);
        Image<glm::dvec3> colors = shade(tracer, trace(tracer));
        const Supersampled sampled = shade_supersampled(tracer, 3);
        colors.pixels.insert(colors.pixels.end(), sampled.color.pixels.begin(),
                             sampled.color.pixels.end());
        return colors.pixels;
    };
    const std::vector<glm::dvec3> one = all(1);
    EXPECT_EQ(one, all(5));
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        EXPECT_EQ(one, all(2));
        hwy::SetSupportedTargetsForTest(0);
    }
}

/// Of the lit pixels, the share that is so.
template <class Predicate>
double share_of_lit(const std::string& name, const Predicate& is_so) {
    const Scene scene = picture_of(name, 128, 128);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    int lit = 0;
    int so = 0;
    for (const Shading& shading : shade_terms(tracer, truth).pixels) {
        lit += shading.lit;
        so += shading.lit && is_so(shading);
    }
    return static_cast<double>(so) / lit;
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

TEST(shading, of_the_scene_under_a_grazing_light_has_self_shadow_between_0_and_1_in_most_places) {
    EXPECT_GT(share_of_lit("grazing_light",
                           [](const Shading& s) {
                               return s.self_shadow_light > 0.05 && s.self_shadow_light < 0.95;
                           }),
              0.5);
}

TEST(shading, near_the_terminator_has_highlights_that_another_self_shadow_would_leave_bright) {
    EXPECT_GT(share_of_lit("terminator_highlight",
                           [](const Shading& s) {
                               const double more = s.self_shadow_half / s.self_shadow_light - 1;
                               return more * largest(s.specular_color) > 4 / 255.0;
                           }),
              0.2);
}

TEST(shading, of_the_bright_scene_is_above_1_before_the_decal_and_below_behind_it) {
    const auto light = [](const Shading& s) {
        return largest(s.light) * s.diffuse + 0.57; // the least of the ambient's channels
    };
    EXPECT_GT(share_of_lit("bright_light", [&](const Shading& s) { return light(s) > 1.05; }), 0.3);
    EXPECT_EQ(share_of_lit("bright_light", [](const Shading& s) { return largest(s.color()) > 1; }),
              0);
}

TEST(shading, under_the_light_that_fades_with_distance_stays_between_0_and_1) {
    EXPECT_EQ(share_of_lit("fine_relief", [](const Shading& s) { return largest(s.color()) > 1; }),
              0);
    EXPECT_GT(
        share_of_lit("fine_relief", [](const Shading& s) { return largest(s.color()) > 0.5; }),
        0.1);
}

TEST(shading, has_a_unit_tangent_at_right_angles_to_the_normal_where_there_is_a_bump_map) {
    const Scene scene = picture_of("bumpy_sphere", 96, 96);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const Image<Shading> terms = shade_terms(tracer, truth);
    int tangents = 0;
    for (std::size_t i = 0; i < terms.pixels.size(); ++i) {
        const Shading& shading = terms.pixels[i];
        const std::uint32_t triangle = truth.triangle.pixels[i];
        const bool bumpy =
            triangle != no_triangle &&
            scene.materials[scene.meshes[mesh_of(scene, triangle)].material].bump != Bump::none;
        EXPECT_NEAR(glm::length(shading.tangent), bumpy ? 1 : 0, rounding);
        EXPECT_NEAR(glm::dot(shading.tangent, shading.normal), 0, rounding);
        tangents += bumpy;
    }
    EXPECT_GT(tangents, 1000);
}

TEST(supersampling, with_one_ray_a_pixel_is_the_truth_at_its_centre) {
    const Scene scene = picture_of("mirrored_skin", 64, 64);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const Supersampled sampled = shade_supersampled(tracer, 1);
    EXPECT_EQ(sampled.color.pixels, shade(tracer, truth).pixels);
    for (std::size_t i = 0; i < truth.triangle.pixels.size(); ++i)
        EXPECT_EQ(sampled.coverage.pixels[i], truth.triangle.pixels[i] == no_triangle ? 0 : 1);
}

TEST(supersampling, is_the_mean_of_rays_through_the_middles_of_equal_squares) {
    const Scene scene = picture_of("bumpy_sphere", 32, 24);
    const Tracer tracer(scene);
    constexpr int n = 5; // no multiple of a packet
    const Supersampled sampled = shade_supersampled(tracer, n);
    bool between = false;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x) {
            glm::dvec3 sum(0);
            int seen = 0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const auto shading = shade_ray(
                        tracer, line_of_sight(scene.camera, x + (i + 0.5) / n, y + (j + 0.5) / n));
                    if (!shading) continue;
                    sum += shading->color();
                    ++seen;
                }
            expect_near(sampled.color.at(x, y), sum / 25.0);
            EXPECT_EQ(sampled.coverage.at(x, y), seen / 25.0);
            between = between || (seen > 0 && seen < n * n);
        }
    EXPECT_TRUE(between);
}

} // namespace
} // namespace shadowproof
