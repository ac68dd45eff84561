// First triangles on rays from anywhere: geometry whose answer is known by hand, and against all
// triangles.
#include "reference/trace/first_met.h"
#include "reference/trace/view.h"
#include "scenes/load/catalog.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

/// Stairs: squares over x from i to i + 1 at height i, and one below all.
Scene stairs() {
    Scene scene;
    const auto add = [&](float x, float width, float height) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (const glm::vec2 at :
             {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
            scene.positions.emplace_back(x + width * at.x, at.y, height);
        scene.triangles.emplace_back(first, first + 1, first + 2);
        scene.triangles.emplace_back(first, first + 2, first + 3);
    };
    add(0, 3, -1);
    for (int i = 0; i < 3; ++i) add(static_cast<float>(i), 1, static_cast<float>(i));
    scene.materials = {{.name = "stone", .double_sided = true}};
    scene.meshes = {
        {.name = "stairs", .triangle_count = static_cast<std::uint32_t>(scene.triangles.size())}};
    scene.lights = {{}};
    return scene;
}

const auto all = [](std::uint32_t) { return true; };

TEST(FirstMet, is_the_nearest_within_the_limits_that_counts) {
    const Scene scene = stairs();
    const Tracer tracer(scene);
    const auto met = [&](const AnyRay& ray,
                         const std::function<bool(std::uint32_t)>& counts = all) {
        return first_met(tracer, std::span(&ray, 1), counts).front();
    };
    const AnyRay down{{1.75, 0.25, 5}, {0, 0, -1}};
    EXPECT_EQ(met(down).triangle, 4U);
    EXPECT_DOUBLE_EQ(met(down).t, 4);
    EXPECT_EQ(met(down, [](std::uint32_t t) { return t < 2; }).triangle, 0U);
    EXPECT_DOUBLE_EQ(met(down, [](std::uint32_t t) { return t < 2; }).t, 6);
    EXPECT_EQ(met({down.origin, down.direction, 4}).triangle, 0U) << "t must exceed near";
    EXPECT_EQ(met({down.origin, down.direction, 0, 4}).triangle, 4U) << "t may be far";
    EXPECT_EQ(met({down.origin, down.direction, 0, 3.9}).triangle, no_triangle);
    EXPECT_TRUE(std::isinf(met({{4, 0.5, 5}, {0, 0, -1}}).t));
    // On the diagonal both triangles are met, at the same place.
    EXPECT_EQ(met({{1.5, 0.5, 5}, {0, 0, -1}}).triangle, 4U);
    // Along the floor of a step it runs in the plane, and meets nothing of it.
    EXPECT_EQ(met({{-1, 0.5, 0}, {1, 0, 0}}).triangle, no_triangle);
}

TEST(FirstMet, is_what_all_triangles_tell_one_by_one) {
    const Scene scene = load_scene("ordinary", {});
    const Tracer tracer(scene);
    Dice dice(11);
    std::vector<AnyRay> rays;
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 origin{dice.between(-3, 3), 8, dice.between(-3, 3)};
        rays.push_back({origin, glm::dvec3(dice.between(-0.4, 0.4), -1, dice.between(-0.4, 0.4))});
    }
    const std::vector<MetTriangle> found = first_met(tracer, rays, all);
    int hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::uint32_t nearest = no_triangle;
        for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
            const Corners t = corners(scene, triangle);
            if (meets(rays[i], t) &&
                (nearest == no_triangle || order_along(rays[i], t, corners(scene, nearest)) < 0))
                nearest = triangle;
        }
        EXPECT_EQ(found[i].triangle, nearest) << i;
        hits += nearest == no_triangle ? 0 : 1;
    }
    EXPECT_GT(hits, 20);
}

} // namespace
} // namespace shadowproof
