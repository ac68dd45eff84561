// Several lights, whose light is added up: truth, claims, and what is caught.
#include "compare/color/color_check.h"
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "compare/evidence.h"
#include "raster/technique.h"
#include "reference/shade/shading.h"
#include "scenes/error.h"
#include "scenes/mesh/topology.h"
#include "tests/compare/traced_scene.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::compared;
using tests::TracedScene;

constexpr int side = 96;

/// Under its last light.
Scene two_lights() {
    Scene scene = tests::load_named("bumpy_lights-spot");
    scene.camera.width = scene.camera.height = side;
    return scene;
}

/// A third light, from behind, between the two.
Scene three_lights() {
    Scene scene = two_lights();
    Light rim = scene.lights.front();
    rim.position = {1.713, 5.471, -4.313};
    rim.color = {0.31, 0.27, 0.43};
    rim.name = "rim";
    scene.lights.insert(scene.lights.begin() + 1, rim);
    scene.light = 2;
    return scene;
}

std::vector<const Technique*> lighting(const Scene& scene) {
    std::vector<const Technique*> all;
    for (const Technique& technique : all_techniques())
        if (technique.lighting != nullptr && suits(technique, scene)) all.push_back(&technique);
    for (const char* joined : {"bump_eye_space+auto", "bump_one_pass+zfail_geometry_shader",
                               "bump_three_pass+cube_map_six_pass", "bump_eye_space+zpass_capped",
                               "bump_three_pass_per_pixel+zp_plus"})
        all.push_back(find_technique(joined));
    return all;
}

bool is_near(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::compMax(glm::abs(a - b)) < 1e-12;
}

/// By each light alone, without ambient light but once.
TEST(AddedLights, are_the_sum_of_what_each_gives) {
    const Scene scene = three_lights();
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const TracedLights before = trace_lights_before(tracer);
    ASSERT_EQ(before.size(), 2U);
    Image<glm::dvec3> sum(side, side, glm::dvec3(0));
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        Scene alone = scene;
        alone.lights = {scene.lights[i]};
        alone.light = 0;
        if (i > 0) alone.ambient = glm::dvec3(0);
        const Tracer traced(alone);
        const Image<glm::dvec3> more = shade(traced, trace(traced));
        for (std::size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += more.pixels[p];
    }
    const Image<glm::dvec3> all = shade(tracer, truth, before);
    EXPECT_TRUE(std::ranges::equal(all.pixels, sum.pixels, is_near));
    const Image<Shading> terms = shade_terms(tracer, truth, before);
    EXPECT_TRUE(std::ranges::equal(all.pixels, terms.pixels, is_near, {}, &Shading::color));
    const Supersampled one_ray = shade_supersampled(tracer, 1, before);
    EXPECT_TRUE(std::ranges::equal(all.pixels, one_ray.color.pixels));
    const auto brightest = [](const Image<glm::dvec3>& picture) {
        return std::ranges::max(picture.pixels, {}, [](const glm::dvec3& c) { return c.x; }).x;
    };
    EXPECT_GT(brightest(all), brightest(shade(tracer, truth)));
}

TEST(AddedLights, of_a_scene_without_bumps_are_none) {
    const Scene scene = tests::load_named("many_lights-rim");
    EXPECT_EQ(added_lights(scene), 0U);
    const Tracer tracer(scene);
    EXPECT_TRUE(trace_lights_before(tracer).empty());
}

/// One that is exact alone is exact in the sum; of the others every colour is predicted.
TEST(AddedLights, of_all_techniques_are_predicted) {
    Gpu gpu(GlPlatform::osmesa);
    for (const auto& scene : {two_lights(), three_lights()}) {
        const TracedScene traced(scene);
        const std::vector<const Technique*> all = lighting(scene);
        ASSERT_GE(all.size(), 10U);
        for (const Technique* technique : all) {
            SCOPED_TRACE(std::string(technique->name) + ", " + std::to_string(scene.light));
            const Frame frame = render(*technique, scene, traced.plan, gpu);
            const Comparison comparison = compared(traced, frame);
            EXPECT_TRUE(is_explained(comparison));
            ASSERT_TRUE(comparison.colors);
            const ColorCheck& colors = *comparison.colors;
            EXPECT_EQ(colors.unpredicted, 0U)
                << "first " << colors.first_unpredicted_x << "," << colors.first_unpredicted_y;
            EXPECT_GT(colors.judged, 3000U);
            if (is_exact(frame.color_model, scene)) {
                EXPECT_EQ(colors.beyond, 0U);
            }
        }
    }
}

/// What a frame claims of a light is what the frame under that light claims.
TEST(AddedLights, are_drawn_as_each_by_itself) {
    Gpu gpu(GlPlatform::osmesa);
    const Scene scene = three_lights();
    const Plan plan = make_plan(scene);
    for (const Technique* technique : lighting(scene)) {
        SCOPED_TRACE(technique->name);
        const Frame sum = render(*technique, scene, plan, gpu);
        ASSERT_EQ(sum.claims_before.size(), 2U);
        for (std::size_t light = 0; light < 3; ++light) {
            Scene under = scene;
            under.light = light;
            const Frame frame = render(*technique, under, make_plan(under), gpu);
            const Image<Visibility>& claim = light < 2 ? sum.claims_before[light] : sum.claim;
            EXPECT_EQ(claim.pixels, frame.claim.pixels);
            EXPECT_GT(std::ranges::count(claim.pixels, Visibility::shadowed), 300);
        }
    }
}

/// Where the first light's count is left in the stencil, the second light does not arrive.
TEST(AddedLights, over_the_stencil_of_the_light_before_are_unexplained) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(two_lights());
    for (const char* name : {"bump_tangent_space", "bump_one_pass"}) {
        SCOPED_TRACE(name);
        const Technique& technique = *find_technique(name);
        Frame frame = render(technique, traced.scene, traced.plan, gpu);
        Scene first = traced.scene;
        first.light = 0;
        const Frame key = render(technique, first, make_plan(first), gpu);
        std::uint64_t changed = 0;
        for (std::size_t i = 0; i < key.color.pixels.size(); ++i) {
            if (key.claim.pixels[i] != Visibility::shadowed ||
                frame.claim.pixels[i] != Visibility::lit || key.counted->counter.pixels[i] == 0)
                continue;
            const glm::vec3 off = frame.color.pixels[i] - key.color.pixels[i];
            changed += glm::compMax(off) > 4 / 255.0 ? 1 : 0;
            frame.color.pixels[i] = key.color.pixels[i];
        }
        ASSERT_GT(changed, 100U);
        const Comparison comparison = compared(traced, frame);
        // Of bytes, some are still within what rounding and interpolation may make of them.
        EXPECT_GT(tests::pixels_of(comparison, Cause::unexplained), changed * 9 / 10);
    }
}

/// Of each pixel two bytes are added; one step more than their rounding is no colour of theirs.
TEST(AddedLights, are_held_to_a_step_of_their_bytes) {
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(two_lights());
    const Technique& technique = *find_technique("bump_one_pass");
    Frame frame = render(technique, traced.scene, traced.plan, gpu);
    const ColorCheck right =
        check_colors(traced.tracer, traced.truth, frame, traced.traced.lights_before());
    std::uint64_t certain = 0; // pixels of which two steps are told apart
    for (std::size_t i = 0; i < frame.color.pixels.size(); ++i) {
        if (right.verdict.pixels[i] == ColorVerdict::as_shown) continue;
        if (frame.color.pixels[i].y > 0.95F) continue;
        frame.color.pixels[i].y += 3 / 255.0F;
        ++certain;
    }
    const ColorCheck off =
        check_colors(traced.tracer, traced.truth, frame, traced.traced.lights_before());
    EXPECT_GT(off.unpredicted, certain / 2);
    EXPECT_EQ(right.unpredicted, 0U);
}

/// bumpy_eye_inside with its canopy behind the eye, under a light behind it that shadows all that
/// is seen, under one whose volumes nowhere meet the near plane, and under the first again.
Scene shadowed_from_behind() {
    Scene scene = tests::load_named("bumpy_eye_inside");
    scene.camera.width = scene.camera.height = side;
    const glm::dvec3 back = glm::normalize(scene.camera.eye);
    const auto canopy = std::ranges::find(scene.meshes, "canopy", &Mesh::name);
    const glm::dvec3 from = corner(scene, canopy->first_triangle, 0);
    const glm::vec3 moved(scene.camera.eye + back - from);
    std::set<std::uint32_t> corners;
    for (const std::uint32_t triangle : triangles_of(*canopy))
        for (int k = 0; k < 3; ++k) corners.insert(scene.triangles[triangle][k]);
    for (const std::uint32_t at : corners) scene.positions[at] += moved;
    Light behind = scene.lights.front();
    behind.position = scene.camera.eye + 3.0 * back;
    Light beside = scene.lights.front();
    beside.position = {-3.313, 7.171, -6.413};
    beside.color = {0.31, 0.27, 0.43};
    scene.lights = {beside, behind, beside};
    return scene;
}

/// auto draws a light none of whose volumes meets the near plane up to a far plane, and another to
/// infinity; together, both to infinity, as the surfaces are the same.
TEST(AddedLights, are_drawn_to_the_same_depths) {
    Gpu gpu(GlPlatform::osmesa);
    Scene scene = shadowed_from_behind();
    for (scene.light = 0; scene.light < 3; ++scene.light) {
        SCOPED_TRACE(scene.light);
        const TracedScene traced(scene);
        for (const char* name : {"bump_tangent_space+auto", "bump_three_pass+auto"}) {
            const Frame frame = render(*find_technique(name), scene, traced.plan, gpu);
            const Comparison comparison = compared(traced, frame);
            EXPECT_TRUE(is_explained(comparison)) << name;
            EXPECT_EQ(comparison.colors->unpredicted, 0U) << name;
            EXPECT_EQ(frame.depth_model.finite(), scene.light == 0);
        }
    }
    scene.light = 2;
    EXPECT_TRUE(render(*find_technique("auto"), scene, make_plan(scene), gpu).depth_model.finite());
}

/// Outside its cone a spot's pass leaves the ambient light as bytes of its own hold it, not as
/// registers would make it.
TEST(AddedLights, of_a_spot_that_is_the_first_end_at_its_cone) {
    Gpu gpu(GlPlatform::osmesa);
    Scene scene = two_lights();
    std::swap(scene.lights[0], scene.lights[1]);
    scene.ambient = {0.3, 0.1, 0.1};
    for (scene.light = 0; scene.light < 2; ++scene.light) {
        const TracedScene traced(scene);
        for (const char* name : {"bump_one_pass", "bump_one_pass_per_pixel", "bump_three_pass"}) {
            const Comparison comparison = compared(traced, name, gpu);
            EXPECT_TRUE(is_explained(comparison)) << name << " " << scene.light;
            EXPECT_EQ(comparison.colors->unpredicted, 0U) << name << " " << scene.light;
        }
    }
}

/// A spot's map does not suit a sum in which there is a point light.
TEST(AddedLights, must_all_be_of_a_kind_that_the_technique_is_for) {
    Gpu gpu(GlPlatform::osmesa);
    const Scene scene = two_lights();
    const Technique& technique = *find_technique("bump_one_pass+spot_map");
    EXPECT_FALSE(suits(technique, scene));
    EXPECT_TRUE(suits(*find_technique("spot_map"), scene));
    EXPECT_THROW(render(technique, scene, make_plan(scene), gpu), Error);
    Scene spots = scene;
    spots.lights.front() = scene.lights.back();
    spots.lights.front().position += glm::dvec3(-7, 0, 0);
    spots.lights.front().direction =
        glm::normalize(glm::dvec3(0.3, 0.5, 0.2) - spots.lights.front().position);
    EXPECT_TRUE(suits(technique, spots));
    const TracedScene traced(spots);
    for (const char* name : {"bump_one_pass+spot_map", "bump_three_pass+spot_map_dual_texture",
                             "bump_three_pass+spot_map_stencil"}) {
        const Comparison comparison = compared(traced, name, gpu);
        EXPECT_TRUE(is_explained(comparison)) << name;
        EXPECT_EQ(comparison.colors->unpredicted, 0U) << name;
        EXPECT_GT(comparison.colors->judged, 3000U) << name;
    }
}

} // namespace
} // namespace shadowproof
