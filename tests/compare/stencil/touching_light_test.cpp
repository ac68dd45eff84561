// A light on a caster, as near as floats tell: seen from there a triangle fills half the sky. Every
// technique draws what is true all the same, or what is predicted of it; there is no excuse.
#include "raster/volumes/stencil.h"
#include "scenes/mesh/touching_light.h"
#include "tests/compare/traced_scene.h"
#include "tests/dice.h"
#include "tests/raster/small_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>

namespace shadowproof {
namespace {

using tests::compared;
using tests::pixels_of;

/// Techniques that are right wherever casters are closed, whatever the near and far planes cut.
constexpr std::array robust{"zfail_clamp",
                            "zfail_infinite",
                            "zfail_reversed",
                            "zfail_half_edge",
                            "zfail_degenerate_quads",
                            "zfail_geometry_shader",
                            "zfail_per_triangle",
                            "zfail_float",
                            "zpass_capped",
                            "auto"};

/// A box turned so that floats do not hold its faces' planes, over a floor; the light at a point of
/// one of its triangles, as its corners' weights say, rounded to float and moved by `off`.
Scene light_on_box(std::uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& off) {
    Scene scene = tests::box_over_floor();
    scene.camera.width = 64;
    scene.camera.height = 64;
    const Mesh& box = scene.meshes.front();
    const glm::dvec3 middle(0, 1.5, 0);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    std::vector<std::uint8_t> turned(scene.positions.size(), 0);
    for (std::uint32_t i = 0; i < box.triangle_count; ++i)
        for (int k = 0; k < 3; ++k) turned[scene.triangles[box.first_triangle + i][k]] = 1;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        if (turned[i] == 0) continue;
        const glm::dvec3 p = glm::dvec3(scene.positions[i]) - middle; // by 1 radian (Rodrigues)
        scene.positions[i] = middle + p * std::cos(1.0) + glm::cross(axis, p) * std::sin(1.0) +
                             axis * glm::dot(axis, p) * (1 - std::cos(1.0));
    }
    const std::uint32_t on = box.first_triangle + triangle;
    const glm::vec3 point(weights.x * corner(scene, on, 0) + weights.y * corner(scene, on, 1) +
                          weights.z * corner(scene, on, 2)); // rounded
    scene.lights[0].position = glm::dvec3(point) + off;
    return scene;
}

glm::dvec3 outwards(std::uint32_t triangle) {
    const Scene scene = light_on_box(triangle, {1, 0, 0}, {0, 0, 0});
    const std::uint32_t on = scene.meshes.front().first_triangle + triangle;
    const glm::dvec3 a = corner(scene, on, 0);
    return glm::normalize(glm::cross(corner(scene, on, 1) - a, corner(scene, on, 2) - a));
}

bool is_robust(std::string_view technique) {
    return std::ranges::any_of(robust, [&](const char* name) { return technique == name; });
}

/// Whether what is truly seen at the pixel, or its visibility, ends within a pixel of it.
bool is_at_edge(const GroundTruth& truth, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.triangle.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.triangle.width - 1); ++u)
            if (truth.triangle.at(u, v) != truth.triangle.at(x, y) ||
                truth.visibility.at(u, v) != truth.visibility.at(x, y))
                return true;
    return false;
}

/// Nothing is unexplained; and robust techniques are right but at edges.
void expect_explained(const tests::TracedScene& traced, Gpu& gpu) {
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, traced.scene)) continue;
        SCOPED_TRACE(technique.name);
        const Comparison comparison = compared(traced, technique, gpu);
        EXPECT_EQ(comparison.evidence.unexplained, 0U)
            << comparison.evidence.first_x << "," << comparison.evidence.first_y;
        EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U)
            << (comparison.first ? comparison.first->x : 0) << ","
            << (comparison.first ? comparison.first->y : 0);
        if (!is_robust(technique.name)) continue;
        EXPECT_EQ(comparison.differing,
                  pixels_of(comparison, Cause::edge) + pixels_of(comparison, Cause::precision));
        for (int y = 0; y < comparison.cause.height; ++y)
            for (int x = 0; x < comparison.cause.width; ++x)
                EXPECT_TRUE(comparison.cause.at(x, y) == no_difference ||
                            is_at_edge(traced.truth, x, y))
                    << x << "," << y;
    }
}

/// Where on a triangle the light may lie.
struct Place {
    const char* name;
    glm::dvec3 weights;
};
const Place places[] = {{"face", {0.3, 0.3, 0.4}},
                        {"edge", {0.4, 0.6, 0}},
                        {"other edge", {0.7, 0, 0.3}},
                        {"corner", {0, 1, 0}}};

class LightOn : public testing::TestWithParam<Place> {};

TEST_P(LightOn, a_closed_caster_every_technique_is_explained_and_robust_ones_are_right) {
    Gpu gpu(GlPlatform::osmesa);
    Dice dice(20261123);
    for (std::uint32_t triangle = 0; triangle < 12; triangle += 5)
        for (const double off : {0.0, 1e-17, 1e-9, 1.2e-7, -1.2e-7, 4e-7}) {
            const glm::dvec3 way(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
            SCOPED_TRACE(fmt::format("triangle {}, off by {}", triangle, off));
            const tests::TracedScene traced(light_on_box(triangle, GetParam().weights, off * way));
            if (off == 0) {
                ASSERT_FALSE(triangles_touching_light(traced.scene).empty());
            }
            expect_explained(traced, gpu);
        }
}

INSTANTIATE_TEST_SUITE_P(Places, LightOn, testing::ValuesIn(places), [](const auto& place) {
    std::string name = place.param.name;
    std::ranges::replace(name, ' ', '_');
    return name;
});

/// Boxes turned this way and that, some inside others or side by side, an open sheet, the eye
/// anywhere; the light on one of their triangles, edges or corners, or some steps of a float or a
/// double off it.
Scene random_scene(Dice& dice) {
    Scene scene = tests::empty_scene();
    scene.camera.width = 48;
    scene.camera.height = 40;
    scene.materials[0].double_sided = dice.one_in(2);
    const auto somewhere = [&](double size) {
        return glm::dvec3(dice.between(-size, size), dice.between(-size, size),
                          dice.between(-size, size));
    };
    tests::add_rectangle(scene, {-6, -2, 6}, {6, -2.1F, 6}, {6, -2, -6}, {-6, -2, -6});
    for (std::size_t boxes = 1 + dice.below(3); boxes > 0; --boxes) {
        const std::size_t first = scene.positions.size();
        const glm::vec3 half(glm::abs(somewhere(1)) + 0.1);
        tests::add_box(scene, -half, half);
        if (dice.one_in(2)) // that shares a face, and so edges, with it
            tests::add_box(scene, {half.x, -half.y, -half.z}, {2 * half.x, half.y, half.z});
        const glm::dvec3 axis = glm::normalize(somewhere(1) + glm::dvec3(0, 0, 2));
        const double angle = dice.one_in(4) ? 0 : dice.between(0, 3);
        const glm::dvec3 middle = somewhere(1.5);
        for (std::size_t i = first; i < scene.positions.size(); ++i) {
            const glm::dvec3 p = scene.positions[i];
            scene.positions[i] = middle + p * std::cos(angle) +
                                 glm::cross(axis, p) * std::sin(angle) +
                                 axis * glm::dot(axis, p) * (1 - std::cos(angle));
        }
    }
    const auto triangle = static_cast<std::uint32_t>(dice.below(scene.triangles.size()));
    const Place& place = places[dice.below(std::size(places))];
    const glm::vec3 on(place.weights.x * corner(scene, triangle, 0) +
                       place.weights.y * corner(scene, triangle, 1) +
                       place.weights.z * corner(scene, triangle, 2));
    constexpr double steps[] = {0, 0, 1e-300, 1e-16, 1e-12, 1.2e-7, 2.4e-7, 1e-6, 1e-5};
    scene.lights[0].position = glm::dvec3(on) + steps[dice.below(std::size(steps))] * somewhere(1);
    const glm::dvec3 eye = dice.one_in(3) ? glm::dvec3(on) + somewhere(0.4) : somewhere(5);
    tests::look_at(scene.camera, eye, dice.one_in(2) ? glm::dvec3(on) : somewhere(1));
    scene.camera.near = dice.one_in(3) ? dice.between(0.05, 1.5) : 0.1;
    return scene;
}

TEST(TouchingLight, random_scenes_are_explained_to_the_last_pixel) {
    Gpu gpu(GlPlatform::osmesa);
    std::uint64_t first = 1;
    std::uint64_t count = 25;
    if (const char* given = std::getenv("SHADOWPROOF_SEEDS"); given != nullptr)
        std::istringstream(given) >> first >> count;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        Dice dice(seed);
        const tests::TracedScene traced(random_scene(dice));
        for (const Technique& technique : all_techniques()) {
            if (!suits(technique, traced.scene)) continue;
            const Comparison comparison = compared(traced, technique, gpu);
            EXPECT_EQ(comparison.evidence.unexplained, 0U)
                << technique.name << " " << comparison.evidence.first_x << ","
                << comparison.evidence.first_y;
            EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U) << technique.name;
            EXPECT_TRUE(comparison.summary.unexplained.empty())
                << technique.name << ": " << comparison.summary.unexplained.front();
        }
    }
}

/// The light on an edge of a box, whose face there another sheet joins. Some triangles count
/// flipped, and so are drawn apart, with sides between them and their neighbours, by the techniques
/// whose volumes shaders make elsewhere.
TEST(TouchingLight, what_counts_flipped_is_drawn_apart_from_what_it_joins) {
    Scene scene = tests::empty_scene();
    scene.camera.width = 48;
    scene.camera.height = 40;
    tests::add_rectangle(scene, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6}, {-6, 0, -6});
    tests::add_box(scene, {-1, 0, 0.5}, {-0.5, 0.5, 1});
    tests::add_rectangle(scene, {-0.5, 0, 0}, {-0.5, 0, 0.5}, {-0.5, 0.5, 0.5}, {-0.5, 0.5, 0});
    tests::look_at(scene.camera, {-3, 2, 2}, {-1, 0.4, 0.5});
    Gpu gpu(GlPlatform::osmesa);
    for (const double y : {0.499999, 0.25, 0.3}) {
        SCOPED_TRACE(y);
        scene.lights[0].position = {-1, y, 0.5};
        const tests::TracedScene traced(scene);
        for (const char* name :
             {"zfail_degenerate_quads", "zfail_geometry_shader", "zfail_reversed"}) {
            const Comparison comparison = compared(traced, name, gpu);
            EXPECT_EQ(comparison.evidence.unexplained, 0U) << name;
            EXPECT_TRUE(comparison.summary.unexplained.empty())
                << name << ": " << comparison.summary.unexplained.front();
        }
    }
}

/// zfail_reversed whose volumes are tampered with once they are made.
Frame tampered(Gpu& gpu, const Scene& scene, const std::function<void(ShadowVolume&)>& tamper) {
    StencilRecipe recipe = zfail_reversed_recipe(scene, make_plan(scene));
    recipe.extruder = [&](const Scene& casters) -> Extruder {
        return [&, extrude = by_silhouettes(casters)] {
            ShadowVolume volume = extrude();
            tamper(volume);
            return volume;
        };
    };
    return draw_stencil_shadows(gpu, scene, recipe);
}

TEST(TouchingLight, no_volumes_at_all_are_found_out) {
    Gpu gpu(GlPlatform::osmesa);
    for (const Place& place : places)
        for (const double off : {1e-9, 4e-7}) {
            SCOPED_TRACE(fmt::format("{} off by {}", place.name, off));
            const tests::TracedScene traced(light_on_box(0, place.weights, off * outwards(0)));
            const Frame right =
                render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
            const Frame frame =
                tampered(gpu, traced.scene, [](ShadowVolume& volume) { volume = {}; });
            const auto counted = std::ranges::count_if(
                right.counted->counter.pixels, [](std::uint32_t count) { return count > 0; });
            EXPECT_GT(counted, 100);
            EXPECT_GT(compared(traced, frame).evidence.unexplained, 0U);
        }
}

TEST(TouchingLight, a_ten_thousandth_off_the_face_the_pictures_are_right) {
    Gpu gpu(GlPlatform::osmesa);
    for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
        const tests::TracedScene traced(
            light_on_box(triangle, {0.3, 0.3, 0.4}, 1e-4 * outwards(triangle)));
        ASSERT_TRUE(triangles_touching_light(traced.scene).empty());
        const Comparison comparison = compared(traced, "zfail_reversed", gpu);
        EXPECT_EQ(comparison.evidence.unexplained, 0U) << triangle;
        EXPECT_LE(pixels_of(comparison, Cause::precision), 4U) << triangle;
        EXPECT_EQ(comparison.differing,
                  pixels_of(comparison, Cause::precision) + pixels_of(comparison, Cause::edge))
            << triangle;
    }
}

} // namespace
} // namespace shadowproof
