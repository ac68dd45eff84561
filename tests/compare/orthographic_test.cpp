// What an orthographic camera sees, drawn and traced: explained to the last pixel, while pictures
// of a camera that stands or looks a little otherwise, and depths a little beyond rounding, are
// not.
#include "compare/verdict.h"
#include "tests/compare/traced_scene.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

namespace shadowproof {
namespace {

using tests::compared;
using tests::TracedScene;

/// A bundled scene, seen by an orthographic camera where its own stands.
Scene in_parallel(const std::string& name, double half_height = 4) {
    Scene scene = tests::load_named(name);
    scene.camera.projection = Projection::orthographic;
    scene.camera.half_height = half_height / scene.unit;
    scene.camera.width = 150;
    scene.camera.height = 100;
    scene.declares_provokes = false; // which is of its own view
    return scene;
}

bool is_explained(const Comparison& comparison) {
    return comparison.summary.unexplained.empty() && comparison.evidence.unexplained == 0 &&
           tests::pixels_of(comparison, Cause::unexplained) == 0;
}

class Orthographic : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Bundled, Orthographic, testing::ValuesIn(tests::bundled_names()),
                         [](const auto& tested) {
                             std::string name = tested.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

TEST_P(Orthographic, pictures_by_all_techniques_that_draw_them_are_explained) {
    const TracedScene traced(in_parallel(GetParam()));
    Gpu gpu(GlPlatform::osmesa);
    int tried = 0;
    for (const Technique& technique : all_techniques()) {
        if (!can_draw(technique, traced.scene)) continue;
        ++tried;
        const Frame frame = render(technique, traced.scene, traced.plan, gpu);
        const Comparison comparison = compared(traced, frame);
        EXPECT_TRUE(is_explained(comparison)) << technique.name << ": " << comparison.summary.words;
        const Verdict verdict =
            judge(traced.scene, known_on(traced.scene, frame, technique.fails_at),
                  technique.by_nature, comparison);
        EXPECT_TRUE(verdict == Verdict::agrees || verdict == Verdict::fails_as_predicted)
            << technique.name << ": " << name_of(verdict);
    }
    EXPECT_GE(tried, 20);
}

/// A frame of a scene that differs a little, judged by the scene.
Comparison of_another(const TracedScene& traced, const char* technique,
                      const std::function<void(Camera&)>& change) {
    Scene other = traced.scene;
    change(other.camera);
    Gpu gpu(GlPlatform::osmesa);
    Frame frame = render(*find_technique(technique), other, make_plan(other), gpu);
    // What is said to have been drawn is the scene's own.
    if (frame.rays) {
        frame.rays->eye = traced.scene.camera.eye;
        frame.rays->forward = traced.scene.camera.forward;
    }
    return compared(traced, frame);
}

TEST(OrthographicFaults, of_a_camera_that_is_a_little_off_are_caught) {
    const TracedScene traced(in_parallel("ordinary"));
    const double pixel = 2 * 4.0 / 100;
    for (const char* technique : {"cube_map_six_pass", "traced_skip", "zpass", "zfail_reversed"}) {
        SCOPED_TRACE(technique);
        EXPECT_TRUE(is_explained(of_another(traced, technique, [](Camera&) {})));
        EXPECT_FALSE(is_explained(of_another(
            traced, technique, [&](Camera& camera) { camera.eye += pixel / 32 * camera.right; })));
        EXPECT_FALSE(is_explained(
            of_another(traced, technique, [](Camera& camera) { camera.half_height *= 1.002; })));
        EXPECT_FALSE(is_explained(of_another(traced, technique, [](Camera& camera) {
            camera.forward = glm::normalize(camera.forward + 1e-3 * camera.right);
        })));
        EXPECT_FALSE(is_explained(of_another(traced, technique, [](Camera& camera) {
            camera.projection = Projection::perspective;
            camera.half_height = 0.4;
        })));
    }
}

/// Seen from straight above, so that the floor has one depth, 20.
Scene from_above(double near, double far) {
    Scene scene = in_parallel("ordinary");
    Camera& camera = scene.camera;
    camera.eye = {0, 20, 0};
    camera.forward = {0, -1, 0};
    camera.right = {1, 0, 0};
    camera.up = {0, 0, -1};
    camera.near = near;
    camera.far = far;
    return scene;
}

/// Off by roundings alone.
TEST(OrthographicFaults, of_depth_beyond_its_roundings_are_caught) {
    const TracedScene traced(from_above(1, 33));
    Gpu gpu(GlPlatform::osmesa);
    const Technique& technique = *find_technique("cube_map_six_pass");
    const Frame frame = render(technique, traced.scene, traced.plan, gpu);
    ASSERT_TRUE(is_explained(compared(traced, frame)));
    const auto floor = std::ranges::find_if(frame.triangle.pixels, [&](std::uint32_t triangle) {
        return triangle != no_triangle &&
               traced.scene.meshes[mesh_of(traced.scene, triangle)].name == "floor";
    });
    ASSERT_NE(floor, frame.triangle.pixels.end());
    const auto pixel = static_cast<std::size_t>(floor - frame.triangle.pixels.begin());
    const auto with_depth = [&](double by) {
        Frame other = frame;
        float& depth = other.depth.pixels[pixel];
        depth = static_cast<float>(depth + by);
        return is_explained(compared(traced, other));
    };
    EXPECT_TRUE(with_depth(std::ldexp(1, -23)));
    EXPECT_FALSE(with_depth(std::ldexp(1, -18)));
    EXPECT_FALSE(with_depth(-std::ldexp(1, -18)));
}

TEST(OrthographicFaults, of_surfaces_beyond_the_planes_and_from_behind_are_caught) {
    const TracedScene traced(in_parallel("ordinary"));
    const auto with_planes = [&](double near, double far) {
        return is_explained(of_another(traced, "cube_map_six_pass", [&](Camera& camera) {
            camera.near = near;
            camera.far = far;
        }));
    };
    const Camera& own = traced.scene.camera;
    double nearest = 1e30;
    double deepest = 0;
    for (const double depth : traced.truth.depth.pixels)
        if (std::isfinite(depth)) {
            nearest = std::min(nearest, depth);
            deepest = std::max(deepest, depth);
        }
    ASSERT_GT(deepest, nearest + 1);
    EXPECT_FALSE(with_planes(0.5 * (nearest + deepest), own.far));
    EXPECT_FALSE(with_planes(own.near, 0.5 * (nearest + deepest)));
}

/// A floor in the far plane, or a little before it. Whether rounding leaves it out there is the
/// driver's; before, it is not.
TEST(OrthographicFaults, that_leave_out_a_floor_before_the_far_plane_are_caught) {
    for (const double beyond : {0.0, 1e-9, 0.01}) {
        SCOPED_TRACE(beyond);
        const TracedScene traced(from_above(0, 20 + beyond));
        Gpu gpu(GlPlatform::osmesa);
        Frame frame = render(*find_technique("cube_map_six_pass"), traced.scene, traced.plan, gpu);
        EXPECT_TRUE(is_explained(compared(traced, frame)));
        for (std::size_t i = 0; i < frame.triangle.pixels.size(); ++i) {
            if (!(traced.truth.depth.pixels[i] > 19.99)) continue;
            frame.triangle.pixels[i] = no_triangle;
            frame.claim.pixels[i] = Visibility::background;
            frame.depth.pixels[i] = 0;
        }
        EXPECT_EQ(is_explained(compared(traced, frame)), beyond < 0.01);
    }
}

TEST(OrthographicFaults, of_rays_from_another_place_are_caught) {
    const TracedScene traced(in_parallel("ordinary"));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("traced_skip"), traced.scene, traced.plan, gpu);
    ASSERT_TRUE(is_explained(compared(traced, frame)));
    Frame other = frame;
    other.rays->forward.x += 1e-3F;
    EXPECT_FALSE(is_explained(compared(traced, other)));
    other = frame;
    other.rays->is_parallel = false;
    EXPECT_FALSE(is_explained(compared(traced, other)));
    other = frame;
    for (TracedPixel& pixel : other.rays->pixels.pixels) pixel.line.y += 1e-4F;
    EXPECT_FALSE(is_explained(compared(traced, other)));
}

/// The sun of a scene from above, shining along its lines of sight, or against them: sides of
/// volumes are seen edge-on, and no line leaves a volume but at infinity.
Scene with_sun(double up, const glm::dvec3& aside) {
    Scene scene = from_above(1, 33);
    Light& light = scene.lights[scene.light];
    light.kind = Light::Kind::directional;
    light.direction = glm::normalize(glm::dvec3(0, up, 0) + aside);
    return scene;
}

TEST(OrthographicVolumes, of_a_sun_that_shines_along_the_lines_of_sight_are_counted) {
    Gpu gpu(GlPlatform::osmesa);
    for (const glm::dvec3& aside : {glm::dvec3(0), glm::dvec3(1e-16, 0, 0),
                                    glm::dvec3(3e-8, 0, 1e-9), glm::dvec3(0, 0, -1e-4)})
        for (const double up : {-1.0, 1.0}) {
            SCOPED_TRACE(testing::Message() << up << ", aside " << glm::length(aside));
            const TracedScene traced(with_sun(up, aside));
            for (const Technique& technique : all_techniques()) {
                if (!can_draw(technique, traced.scene) || technique.recipe == nullptr) continue;
                const Comparison comparison = compared(traced, technique, gpu);
                EXPECT_TRUE(is_explained(comparison)) << technique.name;
                if (technique.name == "zfail_reversed") {
                    EXPECT_EQ(comparison.differing,
                              tests::pixels_of(comparison, Cause::edge) +
                                  tests::pixels_of(comparison, Cause::precision));
                }
            }
        }
}

/// A lamp over a caster and the floor, whose volumes hold the point at infinity where all lines of
/// sight end: every counter starts with their dark caps. Under the caster the lamp puts the eye, at
/// the other end, into its volume, too.
Scene with_lamp(double height) {
    Scene scene = from_above(1, 33);
    Light& light = scene.lights[scene.light];
    light.kind = Light::Kind::point;
    const auto box = std::ranges::find_if(
        scene.meshes, [](const Mesh& mesh) { return mesh.casts && mesh.name != "floor"; });
    glm::dvec3 low(1e30);
    glm::dvec3 high(-1e30);
    for (std::uint32_t i = 0; i < box->triangle_count; ++i)
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, corner(scene, box->first_triangle + i, k));
            high = glm::max(high, corner(scene, box->first_triangle + i, k));
        }
    light.position = 0.5 * (low + high) + glm::dvec3(0.01, 0, 0.013);
    light.position.y = height;
    return scene;
}

TEST(OrthographicVolumes, that_hold_an_end_of_all_lines_of_sight_start_the_counter) {
    Gpu gpu(GlPlatform::osmesa);
    for (const double height : {30.0, 0.01}) {
        SCOPED_TRACE(height);
        const TracedScene traced(with_lamp(height));
        const ShadowDepths& depths = traced.traced.depths();
        const bool is_under = height < 1;
        EXPECT_GT(depths.at_infinity.at(3, 3), 0);
        EXPECT_EQ(depths.at_eye > 0, is_under);
        for (const char* name : {"zfail_reversed", "zfail_clamp", "zfail_float", "zfail_saturate",
                                 "zfail_no_dark_cap", "zpass_eye_count", "auto"}) {
            SCOPED_TRACE(name);
            const Technique& technique = *find_technique(name);
            Frame frame = render(technique, traced.scene, traced.plan, gpu);
            EXPECT_TRUE(is_explained(compared(traced, frame)));
            for (std::uint32_t& count : frame.counted->counter.pixels) count ^= 1U;
            EXPECT_FALSE(is_explained(compared(traced, frame)));
        }
        const Comparison right = compared(traced, *find_technique("zfail_reversed"), gpu);
        EXPECT_EQ(right.differing, tests::pixels_of(right, Cause::edge));
        const Comparison open = compared(traced, *find_technique("zfail_no_dark_cap"), gpu);
        EXPECT_GT(tests::pixels_of(open, Cause::cap), 0);
        const Comparison from_zero = compared(traced, *find_technique("zpass"), gpu);
        EXPECT_EQ(tests::pixels_of(from_zero, Cause::eye_inside) > 0, is_under);
    }
}

/// A floor a step wide, and a plate ten thousand steps away towards the sun, whose shadow's border
/// crosses it: what floats make of the sun's direction is carried all the way.
Scene with_far_plate(double distance) {
    Scene scene = from_above(1, 33);
    Camera& camera = scene.camera;
    camera.half_height = 0.5;
    camera.eye = {0, 20, 0};
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.3711, 0.7177, 0.5893));
    scene.positions = {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    const glm::dvec3 at = distance * to_sun;
    for (const glm::dvec3& corner :
         {glm::dvec3(0.031, 0, -0.017), glm::dvec3(9.7, 0, -4.1), glm::dvec3(5.3, 0, 8.9)})
        scene.positions.emplace_back(at + corner);
    scene.triangles.emplace_back(4, 6, 5);
    scene.triangles.emplace_back(4, 5, 6);
    scene.meshes = {{"floor", 0, 2, 0}, {"plate", 2, 2, 0}};
    scene.materials = {{"plain"}};
    scene.surfaces.clear();
    scene.masks.clear();
    Light& light = scene.lights[scene.light];
    light.kind = Light::Kind::directional;
    light.direction = -to_sun;
    return scene;
}

TEST(OrthographicVolumes, of_a_sun_reach_as_far_as_its_direction_is_known) {
    Gpu gpu(GlPlatform::osmesa);
    for (const double distance : {30.0, 1e3, 1e4, 1e5}) {
        SCOPED_TRACE(distance);
        const TracedScene traced(with_far_plate(distance));
        const std::vector<Visibility>& classes = traced.truth.visibility.pixels;
        EXPECT_GT(std::ranges::count(classes, Visibility::lit), 1000);
        EXPECT_GT(std::ranges::count(classes, Visibility::shadowed), 1000);
        for (const char* name : {"zfail_reversed", "zfail_clamp", "zfail_half_edge"})
            EXPECT_TRUE(is_explained(compared(traced, *find_technique(name), gpu))) << name;
    }
}

} // namespace
} // namespace shadowproof
