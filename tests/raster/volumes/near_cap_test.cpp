#include "raster/render.h"
#include "raster/volumes/near_cap.h"
#include "raster/volumes/volume.h"
#include "scenes/mesh/topology.h"
#include "scenes/plan/plan.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace shadowproof::tests {
namespace {

/// Window depth of view depth t, drawn into [least, 1].
double window_depth(double t, double near, double far, double least, bool parallel = false) {
    return least + (1 - least) * (parallel ? 1 : far / t) * (t - near) / (far - near);
}

TEST(NearCap, depths_on_the_ledge_equal_those_of_the_scene) {
    for (const double near : {0.001, 0.1, 1.0})
        for (const double far : {2.0, 100.0, 1e5})
            for (const double t : {1.0, 1.5, 1.99})
                for (const bool parallel : {false, true})
                    EXPECT_NEAR(window_depth(
                                    t, ledge_near({.near = near, .far = far, .parallel = parallel}),
                                    far, 0, parallel),
                                window_depth(t, near, far, ledge, parallel), 1e-15);
}

TEST(NearCap, the_source_s_sign_would_part_them) {
    // n = .1, f = 1, N = 1, F = 100, n' = .05, as the slide has it and as it must be.
    const double right = 0.9 * 100 / (100 - 0.1 - 0.05 * 99);
    const double wrong = 0.9 * 100 / (100 - 0.1 + 0.05 * 99);
    const double scene = window_depth(5, 1, 100, 0.1);
    EXPECT_NEAR(window_depth(5, right, 100, 0.05), scene, 1e-12);
    EXPECT_GT(std::abs(window_depth(5, wrong, 100, 0.05) - scene), 0.01);
}

/// Directed edges that no opposite one balances.
std::size_t unbalanced_edges(const NearCut& cut) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> surplus;
    for (const auto* part : {&cut.sides, &cut.caps})
        for (const glm::uvec3& triangle : *part)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = triangle[k];
                const std::uint32_t b = triangle[(k + 1) % 3];
                if (a < b) ++surplus[{a, b}];
                if (b < a) --surplus[{b, a}];
            }
    std::size_t unbalanced = 0;
    for (const auto& [edge, count] : surplus) {
        // Edges on the near plane are shared by a cap and a side; others, of light and dark caps
        // that are not drawn here, lie open.
        const double near = 1;
        const auto on_plane = [&](std::uint32_t i) {
            const glm::vec4& p = cut.points[i];
            return p.w > 0 ? p.z == -static_cast<float>(near) : p.z == 0;
        };
        const bool at_infinity = cut.points[edge.first].w == 0 && cut.points[edge.second].w == 0;
        if (count != 0 && !at_infinity && on_plane(edge.first) && on_plane(edge.second))
            ++unbalanced;
    }
    return unbalanced;
}

TEST(NearCap, caps_and_sides_meet_without_a_crack_wherever_the_light_is) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> wide(-6, 6);
    std::size_t caps = 0;
    for (int round = 0; round < 200; ++round) {
        Scene scene = empty_scene();
        scene.camera.near = 1;
        look_at(scene.camera, {0, 0, 0}, {0, 0, -5});
        scene.lights[0].position = {wide(random), wide(random), wide(random)};
        const glm::vec3 low(wide(random), wide(random), wide(random));
        add_box(scene, low, low + glm::vec3(1.25F, 0.75F, 1.5F));
        const NearCut cut = cut_at_near_plane(scene, weld_by_position(scene.positions),
                                              triangles_facing_light(scene), {});
        // The casters' own faces that pass the near plane are drawn apart: their edges on it stay.
        bool passes = false;
        for (int corner = 0; corner < 8; ++corner) {
            const double depth =
                view_depth(scene.camera, scene.positions[static_cast<std::size_t>(corner)]);
            passes = passes || (depth < 1) != (view_depth(scene.camera, scene.positions[0]) < 1);
        }
        if (!passes) {
            EXPECT_EQ(unbalanced_edges(cut), 0U) << "round " << round;
        }
        caps += cut.caps.size();
        for (const glm::vec4& point : cut.points) {
            EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
            EXPECT_LE(point.z, point.w > 0 ? -1 : 0);
        }
    }
    EXPECT_GT(caps, 100U);
}

// A face so steep that at pixel (87, 21), whose centre lies beside it but for the snapping of its
// corners, it comes out in front of the near plane that cuts it: the cap has to be before it still.
TEST(NearCap, lies_before_a_surface_that_comes_out_in_front_of_the_near_plane) {
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    scene.positions = {
        {1.88457453F, 1.35104215F, -2.94655919F},  {1.20788968F, 1.00289631F, -3.30888104F},
        {1.20788968F, 0.16336228F, -2.50219393F},  {1.88457453F, 0.511508167F, -2.13987231F},
        {1.37564731F, 1.8259089F, -2.45235658F},   {0.69896251F, 1.47776306F, -2.81467843F},
        {0.69896251F, 0.638229072F, -2.00799155F}, {1.37564731F, 0.986374915F, -1.64566958F}};
    scene.triangles = {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                       {3, 7, 6}, {3, 6, 2}, {0, 4, 7}, {0, 7, 3}, {1, 2, 6}, {1, 6, 5}};
    scene.meshes = {{"box", 0, 12, 0}};
    scene.lights[0].position = {0.07975326501338587, 1.2650617683428236, -0.9577041016370007};
    Camera& camera = scene.camera;
    camera.eye = {2.701567330998542, 0.7548501133101488, -3.7439834961615084};
    camera.right = {-0.8393343077018764, 0.0, -0.5436155994033023};
    camera.up = {0.0746628438490103, 0.9905232816627989, -0.11527830772672579};
    camera.forward = {-0.5384639074840485, 0.13734492522099018, 0.8313801728770361};
    camera.half_height = std::tan(0.45);
    camera.near = 1.5;
    camera.width = camera.height = 128;
    Gpu gpu(GlPlatform::osmesa);
    const Plan plan = make_plan(scene);
    const Frame capped = render(*find_technique("zpass_capped"), scene, plan, gpu);
    ASSERT_NE(capped.triangle.at(87, 21), no_triangle);
    EXPECT_LT(capped.depth.at(87, 21), ledge);
    EXPECT_EQ(capped.counted->counter.at(87, 21), capped.counted->counter.at(86, 21));
    EXPECT_NE(capped.counted->counter.at(87, 21), 0U);
}

} // namespace
} // namespace shadowproof::tests
