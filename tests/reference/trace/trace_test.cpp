#include "reference/predict/ledger.h"
#include "reference/trace/any_rays.h"
#include "reference/trace/trace.h"
#include "reference/witness/witness.h"
#include "scenes/load/catalog.h"
#include "tests/reference/hard_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

class HardSceneTest : public testing::TestWithParam<HardScene> {};

TEST_P(HardSceneTest, not_one_pixel_differs_from_brute_force_over_rationals) {
    const Scene scene = GetParam().make();
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const witness::Witness witness(scene);
    for (int y = 0; y < scene.camera.height; ++y)
        for (int x = 0; x < scene.camera.width; ++x) {
            const witness::Answer expected =
                witness.look(line_of_sight(scene.camera, x + 0.5, y + 0.5));
            ASSERT_EQ(truth.triangle.at(x, y), expected.triangle) << "at " << x << ", " << y;
            ASSERT_EQ(truth.visibility.at(x, y), expected.visibility) << "at " << x << ", " << y;
        }
}

/// Where few signs are exactly zero, floats must decide nearly all, however far the light is. Seen
/// from there, the scene would be a speck.
TEST(FarLight, leaves_no_more_undecided_than_one_near_by) {
    Scene scene = load_scene("overlapping", {});
    scene.camera.width = scene.camera.height = 64;
    const glm::dvec3 place = scene.lights[0].position;
    for (const double factor : {1.0, 1e4, 1e6, 1e9, 1e15}) {
        scene.lights[0].position = factor * place;
        const TraceStatistics statistics = trace(Tracer(scene)).statistics;
        EXPECT_LT(statistics.undecided, statistics.rays / 50) << factor;
    }
}

/// An orthographic camera's lines of sight are as easy to decide.
TEST(Orthographic, leaves_no_more_undecided_than_perspective) {
    Scene scene = load_scene("overlapping", {});
    scene.camera.width = scene.camera.height = 64;
    scene.camera.projection = Projection::orthographic;
    for (const double half_height : {0.01, 1.0, 5.0}) {
        scene.camera.half_height = half_height;
        const TraceStatistics statistics = trace(Tracer(scene)).statistics;
        EXPECT_GT(statistics.lit + statistics.shadowed, 1000U) << half_height;
        EXPECT_LT(statistics.undecided, statistics.rays / 50) << half_height;
    }
}

/// A needle whose normal doubles take for 0, and so no depth is known where a ray meets it.
TEST(Needle, whose_depth_no_double_knows_is_shadowed_by_what_stands_between) {
    Scene scene = empty_scene(4);
    const glm::vec3 tip(std::ldexp(1.0F, -35) - std::ldexp(1.0F, -24), std::ldexp(1.0F, -35), -1);
    add_triangle(scene, tip, {1, 1, -1}, {-1 - std::ldexp(1.0F, -23), -1, -1});
    for (int i = -10; i < 10; ++i)
        for (int j = -10; j < 10; ++j) {
            const glm::vec3 at(0.5F * static_cast<float>(i), 0.5F * static_cast<float>(j), 0.5F);
            add_triangle(scene, at, at + glm::vec3(0.5F, 0, 0), at + glm::vec3(0, 0.5F, 0));
            add_triangle(scene, at + glm::vec3(0, 0.5F, 0), at + glm::vec3(0.5F, 0, 0),
                         at + glm::vec3(0.5F, 0.5F, 0));
        }
    finish(scene, true);
    scene.camera.near = 0.01;
    const glm::dvec3 direction(tip);
    for (const Light::Kind kind : {Light::Kind::directional, Light::Kind::point}) {
        scene.lights[0].kind = kind;
        scene.lights[0].direction = {-0.1, -0.05, -1};
        scene.lights[0].position = {0.1, 0.05, 10};
        const Tracer tracer(scene);
        const witness::Answer expected = witness::Witness(scene).look(direction);
        EXPECT_EQ(expected.visibility, Visibility::shadowed);
        const RayTruth truth = trace_ray(tracer, direction);
        EXPECT_EQ(truth.triangle, 0U);
        EXPECT_EQ(truth.visibility, expected.visibility);
        EXPECT_TRUE(stands_between(tracer, {scene.camera.eye, direction}, 0,
                                   occluder_of(tracer, direction)));
    }
}

TEST_P(HardSceneTest, the_occluder_is_the_lowest_numbered_triangle_that_stands_between) {
    const Scene scene = GetParam().make();
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    for (int y = 0; y < scene.camera.height; ++y)
        for (int x = 0; x < scene.camera.width; ++x) {
            const glm::dvec3 line = line_of_sight(scene.camera, x + 0.5, y + 0.5);
            const AnyRay ray{start_of(scene.camera, line), direction_of(scene.camera, line)};
            const std::uint32_t seen = truth.triangle.at(x, y);
            std::uint32_t lowest = no_triangle;
            if (seen != no_triangle && faces_light(tracer, seen) &&
                receives_shadows(tracer, seen) && within_cone(tracer, ray, seen))
                for (std::uint32_t i = 0; i < scene.triangles.size() && lowest == no_triangle; ++i)
                    if (stands_between(tracer, ray, seen, i)) lowest = i;
            ASSERT_EQ(occluder_of(tracer, line), lowest) << x << ", " << y;
        }
}

TEST_P(HardSceneTest, shadow_depths_equal_those_of_brute_force_with_a_really_moved_ray) {
    const Scene scene = GetParam().make();
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const double far = 1.5 * scene.camera.half_height + 6 * scene.camera.near / 0.125;
    const ShadowDepths depths = count_shadow_depths(tracer, truth, far);
    const witness::Witness witness(scene);
    EXPECT_EQ(depths.at_eye, witness.shadow_depth_at_eye());
    for (int y = 0; y < scene.camera.height; ++y)
        for (int x = 0; x < scene.camera.width; ++x) {
            const glm::dvec3 d = line_of_sight(scene.camera, x + 0.5, y + 0.5);
            const auto at = [&](double depth) {
                return witness.shadow_depth(witness.on_ray(d, depth), no_triangle);
            };
            ASSERT_EQ(depths.at_near.at(x, y), at(scene.camera.near)) << x << ", " << y;
            ASSERT_EQ(depths.at_far.at(x, y), at(far)) << x << ", " << y;
            ASSERT_EQ(depths.at_infinity.at(x, y), witness.shadow_depth_at_infinity(d))
                << x << ", " << y;
            const std::uint32_t own = truth.triangle.at(x, y);
            if (own == no_triangle) continue;
            const bool behind = witness.side_of_eye(own) < 0 && witness.side_of_light(own) > 0;
            ASSERT_EQ(depths.at_surface.at(x, y),
                      witness.shadow_depth(witness.look(d).hit, own) + (behind ? 1 : 0))
                << x << ", " << y;
        }
}

TEST_P(HardSceneTest, what_a_spots_cone_holds_equals_brute_force_and_is_asked_of_spots_only) {
    const Scene scene = GetParam().make();
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    if (chosen_light(scene).kind != Light::Kind::spot) {
        EXPECT_TRUE(truth.in_cone.pixels.empty());
        return;
    }
    const witness::Witness witness(scene);
    int inside = 0;
    int outside = 0;
    for (int y = 0; y < scene.camera.height; ++y)
        for (int x = 0; x < scene.camera.width; ++x) {
            const glm::dvec3 direction = line_of_sight(scene.camera, x + 0.5, y + 0.5);
            const witness::Answer expected = witness.look(direction);
            const bool in_cone =
                expected.triangle != no_triangle && witness.side_of_cone(expected.hit) >= 0;
            ASSERT_EQ(truth.in_cone.at(x, y) != 0, in_cone) << x << ", " << y;
            if (expected.triangle == no_triangle) continue;
            ASSERT_EQ(trace_ray(tracer, direction).in_cone, in_cone) << x << ", " << y;
            ++(in_cone ? inside : outside);
        }
    EXPECT_GT(inside, 10);
    EXPECT_GT(outside, 10);
}

/// How high a perspective picture is, by half, at the depth of half of the vertices.
double height_at_middle(const Scene& scene) {
    std::vector<double> depths;
    for (const glm::dvec3 position : scene.positions)
        depths.push_back(view_depth(scene.camera, position));
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::ranges::nth_element(depths, middle);
    return std::max(*middle, scene.camera.near) * scene.camera.half_height;
}

/// Pixels of a bundled scene whose right neighbour has another class: there floats are wrong first.
std::vector<std::pair<int, int>> pixels_at_boundaries(const GroundTruth& truth) {
    std::vector<std::pair<int, int>> pixels;
    for (int y = 0; y < truth.visibility.height; ++y)
        for (int x = 0; x + 1 < truth.visibility.width; ++x)
            if (truth.visibility.at(x, y) != truth.visibility.at(x + 1, y))
                pixels.emplace_back(x, y);
    return pixels;
}

class BoundariesOfBundledScenes : public testing::TestWithParam<Projection> {};

TEST_P(BoundariesOfBundledScenes, equal_brute_force_over_rationals) {
    constexpr std::uint32_t seed = 20260102;
    std::mt19937 random(seed);
    for (const BundledScene& bundled : bundled_scenes()) {
        Scene scene = load_scene(std::string(bundled.name), {});
        scene.camera.projection = GetParam();
        scene.camera.half_height = height_at_middle(scene);
        const GroundTruth truth = trace(Tracer(scene));
        const witness::Witness witness(scene);
        std::vector<std::pair<int, int>> pixels = pixels_at_boundaries(truth);
        std::shuffle(pixels.begin(), pixels.end(), random);
        pixels.resize(std::min<std::size_t>(pixels.size(), 25));
        for (const auto& [x, y] : pixels) {
            const witness::Answer expected =
                witness.look(line_of_sight(scene.camera, x + 0.5, y + 0.5));
            EXPECT_EQ(truth.triangle.at(x, y), expected.triangle)
                << bundled.name << " at " << x << ", " << y << ", seed " << seed;
            EXPECT_EQ(truth.visibility.at(x, y), expected.visibility)
                << bundled.name << " at " << x << ", " << y << ", seed " << seed;
        }
    }
}

std::string test_name(const testing::TestParamInfo<HardScene>& scene) {
    std::string name = scene.param.name;
    std::ranges::replace(name, '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Reference, BoundariesOfBundledScenes,
                         testing::Values(Projection::perspective, Projection::orthographic));
INSTANTIATE_TEST_SUITE_P(Reference, HardSceneTest, testing::ValuesIn(hard_scenes()), test_name);
INSTANTIATE_TEST_SUITE_P(Orthographic, HardSceneTest, testing::ValuesIn(orthographic_scenes()),
                         test_name);

} // namespace
} // namespace shadowproof
