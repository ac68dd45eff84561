#include "compare/driver/neighbourhood.h"
#include "scenes/camera.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>
#include <set>

namespace shadowproof {
namespace {

constexpr double reach = 0.01; ///< pixels

Neighbourhood around_a_pixel() {
    Camera camera;
    camera.width = camera.height = 64;
    return neighbourhood(camera, {40.5, 20.5}, {.surface = reach, .nearest = 0});
}

/// A ray through a place of the neighbourhood whose corners are (-1, -1) to (1, 1).
glm::dvec3 through(const Neighbourhood& around, const glm::dvec2& place) {
    return around.rays.front() + 0.5 * (place.x * (around.corners[1] - around.corners[0]) +
                                        place.y * (around.corners[3] - around.corners[0]));
}

/// The plane through the eye and two such rays.
SightPlane plane_through(const Neighbourhood& around, const glm::dvec2& a, const glm::dvec2& b) {
    return {glm::cross(through(around, a), through(around, b)), 0};
}

std::vector<bool> part_of(const std::vector<SightPlane>& planes, const glm::dvec3& ray) {
    std::vector<bool> part;
    for (const SightPlane& plane : planes) part.push_back(plane.side(ray) < 0);
    return part;
}

TEST(RaysBetween, lie_in_every_part_that_planes_divide_the_neighbourhood_into) {
    const Neighbourhood around = around_a_pixel();
    std::mt19937 random(20260402);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const auto place = [&] { return glm::dvec2(anywhere(random), anywhere(random)); };
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<SightPlane> planes;
        for (int i = 0; i < 1 + trial % 7; ++i)
            planes.push_back(plane_through(around, place(), place()));
        std::set<std::vector<bool>> found;
        for (const glm::dvec3& ray : rays_between(around, planes)) {
            EXPECT_LE(glm::length(ray - around.rays.front()),
                      glm::length(around.corners[0] - around.rays.front()));
            EXPECT_TRUE(found.insert(part_of(planes, ray)).second) << "the same part twice";
        }
        for (int i = 0; i < 10000; ++i)
            EXPECT_TRUE(found.contains(part_of(planes, through(around, place()))))
                << "trial " << trial;
    }
}

TEST(RaysBetween, lie_in_a_part_a_millionth_as_wide_as_the_neighbourhood) {
    const Neighbourhood around = around_a_pixel();
    const std::vector<SightPlane> planes{plane_through(around, {0.3, -1}, {0.2, 1}),
                                         plane_through(around, {0.300001, -1}, {0.200001, 1})};
    std::set<std::vector<bool>> found;
    for (const glm::dvec3& ray : rays_between(around, planes)) found.insert(part_of(planes, ray));
    EXPECT_EQ(found.size(), 3U);
}

TEST(RaysBetween, are_none_where_no_plane_passes) {
    const Neighbourhood around = around_a_pixel();
    EXPECT_TRUE(rays_between(around, {}).empty());
    EXPECT_TRUE(rays_between(around, {plane_through(around, {3, -1}, {3, 1})}).empty());
}

/// Over (-1, 0) to (1, 0) at depth 5: what lies above in one triangle, what lies below in two whose
/// upper corners are others; and far behind, one that covers everything.
Scene t_junction() {
    Scene scene = tests::empty_scene();
    scene.positions = {{-1, 0, 0},     {1, 0, 0},     {0, 1, 0},              //
                       {-2, 0, 0},     {0, 0, 0},     {2, 0, 0},  {0, -1, 0}, //
                       {-99, -99, -9}, {99, -99, -9}, {0, 99, -9}};
    scene.triangles = {{0, 1, 2}, {3, 6, 4}, {4, 6, 5}, {7, 8, 9}};
    scene.meshes = {{"all", 0, 4, 0}};
    scene.materials = {{"plain", true}};
    return scene;
}

TEST(MayGape, only_where_groups_that_share_no_edge_part) {
    const Scene scene = t_junction();
    const std::vector<glm::dvec3> rays{{-0.01, 0.001, -1},  {0, 0.001, -1},  {0.01, 0.001, -1},
                                       {-0.01, -0.001, -1}, {0, -0.001, -1}, {0.01, -0.001, -1}};
    EXPECT_TRUE(may_gape(scene, {0, 1, 2}, rays));
    EXPECT_FALSE(may_gape(scene, {0, 1, 2, 3}, rays)) << "the one behind has no gap";
    EXPECT_FALSE(may_gape(scene, {1, 2}, std::span(rays).last(3))) << "they share an edge";
    EXPECT_FALSE(may_gape(scene, {0}, rays)) << "one group has no other to part from";
    EXPECT_FALSE(may_gape(scene, {}, rays));
}

TEST(MayGape, does_not_let_the_background_shine_through_a_floor_behind_a_box) {
    const tests::TracedScene traced(tests::box_over_floor());
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    // Along the box's upper edge that is nearest to the eye.
    for (const float x : {-0.5F, 0.0F, 0.3F}) {
        const tests::Pixel p = tests::pixel_of(traced.scene, {x, 2, 1});
        for (int dy = -1; dy <= 1; ++dy) {
            Frame faulty = frame;
            faulty.claim.at(p.x, p.y + dy) = Visibility::background;
            faulty.triangle.at(p.x, p.y + dy) = no_triangle;
            faulty.counted->counter.at(p.x, p.y + dy) = 0;
            const Comparison comparison = tests::compared(traced, faulty);
            EXPECT_EQ(tests::pixels_of(comparison, Cause::unexplained), 1U) << x << ", " << dy;
        }
    }
}

} // namespace
} // namespace shadowproof
