#include "raster/volumes/split_volume.h"
#include "tests/dice.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <tuple>

namespace shadowproof::tests {
namespace {

/// A box with the light on one of its triangles.
Scene light_on_box(Dice& dice, const glm::dvec3& weights, double off) {
    Scene scene = empty_scene();
    add_box(scene, {-0.7F, 0.3F, -1.1F}, {0.9F, 1.3F, 0.2F});
    const auto triangle = static_cast<std::uint32_t>(dice.below(12));
    scene.lights[0].position =
        weights.x * corner(scene, triangle, 0) + weights.y * corner(scene, triangle, 1) +
        weights.z * corner(scene, triangle, 2) +
        off * glm::dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    return scene;
}

TEST(SplitVolume, is_closed) {
    int split_volumes = 0;
    for (const glm::dvec3 weights : {glm::dvec3(0.3, 0.3, 0.4), {0.25, 0.75, 0}, {0, 0, 1}})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(seed);
            Dice dice(seed);
            const Scene scene = light_on_box(dice, weights, 1e-9);
            const auto count = static_cast<std::uint32_t>(scene.positions.size());
            const SplitFarEnds split = split_far_ends(scene);
            split_volumes += split.empty() ? 0 : 1;
            const ShadowVolume volume =
                with_split_far_ends(by_silhouettes(scene), scene, split, 2 * count)();
            // Corners by their place: here, away from the light, or along a direction.
            using Corner = std::array<double, 4>;
            const auto place = [&](std::uint32_t number) -> Corner {
                if (number >= 2 * count) {
                    const glm::dvec3 d = split.directions[number - 2 * count];
                    return {d.x, d.y, d.z, 2};
                }
                const glm::vec3 p = scene.positions[number % count];
                return {p.x, p.y, p.z, number < count ? 1.0 : 0.0};
            };
            std::map<std::pair<Corner, Corner>, int> edges;
            const auto add = [&](const std::vector<glm::uvec3>& triangles, int times) {
                for (const glm::uvec3& t : triangles)
                    for (int k = 0; k < 3; ++k) {
                        edges[{place(t[k]), place(t[(k + 1) % 3])}] += times;
                        edges[{place(t[(k + 1) % 3]), place(t[k])}] -= times;
                    }
            };
            add(volume.light_cap, 1);
            add(volume.sides, 1);
            add(volume.flipped_sides, -1); // wound as if they were not
            add(volume.dark_cap, 1);
            for (const auto& [edge, surplus] : edges) EXPECT_EQ(surplus, 0);
        }
    EXPECT_GT(split_volumes, 20);
}

TEST(SplitVolume, of_a_light_off_the_caster_is_the_volume_itself) {
    Dice dice(1);
    const Scene scene = light_on_box(dice, {0.3, 0.3, 0.4}, 0.5);
    const SplitFarEnds split = split_far_ends(scene);
    ASSERT_TRUE(split.empty());
    const ShadowVolume whole = by_silhouettes(scene)();
    const ShadowVolume same = with_split_far_ends(by_silhouettes(scene), scene, split, 0)();
    EXPECT_EQ(same.sides, whole.sides);
    EXPECT_EQ(same.dark_cap, whole.dark_cap);
}

} // namespace
} // namespace shadowproof::tests
