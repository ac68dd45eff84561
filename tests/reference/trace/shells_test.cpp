// The judge's shells, flips and fillings of holes: by hand, and against the techniques' own, which
// share no code with them.
#include "reference/trace/shells.h"
#include "scenes/mesh/counted_casters.h"
#include "scenes/mesh/holes.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace shadowproof {
namespace {

using Averted = Counting::Flips::Averted;

/// A closed box around `middle`, wound outwards, the light above it.
Scene box(float half, const glm::vec3& middle = {0, 0, 0}) {
    Scene scene;
    scene.materials = {{"plain", false}};
    scene.lights.emplace_back();
    scene.lights[0].position = {0.1, 9, 0.2};
    for (unsigned i = 0; i < 8; ++i)
        scene.positions.push_back(middle + half * glm::vec3((i & 1U) != 0 ? 1 : -1,
                                                            (i & 2U) != 0 ? 1 : -1,
                                                            (i & 4U) != 0 ? 1 : -1));
    scene.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    scene.meshes = {{"box", 0, 12, 0}};
    return scene;
}

void add(Scene& scene, const Scene& other) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.insert(scene.positions.end(), other.positions.begin(), other.positions.end());
    for (const glm::uvec3& triangle : other.triangles) scene.triangles.push_back(triangle + first);
    scene.meshes[0].triangle_count = static_cast<std::uint32_t>(scene.triangles.size());
}

void flip(Scene& scene) {
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.x, triangle.y);
}

std::ptrdiff_t flipped(const Scene& scene, Counting::Flips flips) {
    const std::vector<std::uint8_t> flags = flipped_triangles(Tracer(scene), flips);
    return std::count(flags.begin(), flags.end(), std::uint8_t{1});
}

TEST(Shells, are_what_hangs_together_by_edges) {
    Scene scene = box(1);
    add(scene, box(1, {5, 0, 0}));
    scene.triangles.pop_back();
    scene.meshes[0].triangle_count = 23;
    Scene inverted = box(0.25F, {-5, 0, 0});
    flip(inverted);
    add(scene, inverted);
    scene.lights[0].position = {0.2, 0.3, -0.4};
    const Shells shells = find_shells(scene);
    ASSERT_EQ(shells.all.size(), 3U);
    EXPECT_TRUE(shells.all[0].closed && shells.all[0].holds_light && !shells.all[0].inverted);
    EXPECT_FALSE(shells.all[1].closed || shells.all[1].holds_light);
    EXPECT_TRUE(shells.all[2].closed && !shells.all[2].holds_light && shells.all[2].inverted);
    EXPECT_EQ(shells.of(shells.all[1]).front(), 12U);
    EXPECT_EQ(shells.of(shells.all[1]).size(), 11U);
}

TEST(Shells, are_flipped_as_a_rule_says) {
    Scene scene = box(1);
    EXPECT_EQ(flipped(scene, {}), 0);
    EXPECT_EQ(flipped(scene, {.around_light = true, .averted = Averted::of_faulty_shells}), 0);
    EXPECT_EQ(flipped(scene, {.averted = Averted::of_all_shells}), 10); // all but the top
    scene.lights[0].position = {0.3, -0.2, 0.9};
    EXPECT_EQ(flipped(scene, {.around_light = true}), 12);
    EXPECT_EQ(flipped(scene, {.averted = Averted::of_all_shells}), 0); // the light is inside
    EXPECT_EQ(flipped(scene, {.around_light = true, .averted = Averted::of_all_shells}), 12);
    scene.triangles.pop_back();
    --scene.meshes[0].triangle_count;
    EXPECT_EQ(flipped(scene, {.around_light = true}), 0);
    EXPECT_EQ(flipped(scene, {.averted = Averted::of_faulty_shells}), 11);
}

/// Boxes, some without a triangle or two, some inside out, some sharing an edge or a corner.
Scene any_soup(Dice& dice) {
    Scene scene = box(1);
    for (int i = 0; i < 4; ++i) {
        const auto place = [&] { return static_cast<float>(dice.below(5)) - 2; };
        Scene other = box(dice.below(2) == 0 ? 1 : 0.5F, {place(), place(), place()});
        if (dice.below(3) == 0) flip(other);
        for (auto missing = dice.below(3); missing > 0; --missing)
            other.triangles.erase(other.triangles.begin() +
                                  static_cast<std::ptrdiff_t>(dice.below(other.triangles.size())));
        add(scene, other);
    }
    const auto somewhere = [&] { return 0.013 * static_cast<double>(dice.below(400)) - 2.6; };
    scene.lights[0].position = {somewhere(), somewhere(), somewhere()};
    return scene;
}

TEST(Shells, are_flipped_and_filled_as_techniques_do_it_whatever_the_soup) {
    int around = 0;
    int filled = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const Scene scene = any_soup(dice);
        const Tracer tracer(scene);
        EXPECT_EQ(flipped_triangles(tracer, {.around_light = true}), triangles_around_light(scene));
        EXPECT_EQ(
            flipped_triangles(tracer, {.around_light = true, .averted = Averted::of_faulty_shells}),
            triangles_to_flip(scene));
        const std::vector<glm::uvec3> lids = lids_of(scene);
        std::vector<glm::uvec3> with = scene.triangles;
        with.insert(with.end(), lids.begin(), lids.end());
        EXPECT_EQ(with, with_holes_filled(scene).triangles);
        around += triangles_around_light(scene).empty() ? 0 : 1;
        filled += lids.empty() ? 0 : 1;
    }
    EXPECT_GT(around, 10);
    EXPECT_GT(filled, 100);
}

} // namespace
} // namespace shadowproof
