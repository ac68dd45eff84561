#include "reference/predict/ledger.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "tests/dice.h"
#include "tests/reference/hard_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace shadowproof {
namespace {

class DeterminismTest : public testing::TestWithParam<HardScene> {};

void expect_same(const GroundTruth& one, const GroundTruth& other) {
    EXPECT_EQ(one.visibility.pixels, other.visibility.pixels);
    EXPECT_EQ(one.triangle.pixels, other.triangle.pixels);
    EXPECT_EQ(one.depth.pixels, other.depth.pixels);
    EXPECT_EQ(one.exactness.pixels, other.exactness.pixels);
    EXPECT_EQ(one.statistics.exact_decisions, other.statistics.exact_decisions);
}

void expect_same_with_every_instruction_set(const Scene& scene, const GroundTruth& expected) {
    for (const char* set : {"sse2", "ssse3", "sse4", "avx2", "avx512"}) {
        setenv("SHADOWPROOF_INSTRUCTION_SET", set, 1);
        try {
            const Tracer tracer(scene, 1);
            expect_same(trace(tracer), expected);
        } catch (const Error& error) {
            EXPECT_STRNE(set, "sse2") << error.what(); // the processor lacks another
        }
    }
    unsetenv("SHADOWPROOF_INSTRUCTION_SET");
}

TEST_P(DeterminismTest, one_thread_and_five_find_the_same_bits) {
    const Scene scene = GetParam().make();
    const GroundTruth one = trace(Tracer(scene, 1));
    const GroundTruth five = trace(Tracer(scene, 5));
    expect_same(one, five);
}

TEST_P(DeterminismTest, every_instruction_set_finds_the_same_bits) {
    const Scene scene = GetParam().make();
    const GroundTruth widest = trace(Tracer(scene, 1));
    expect_same_with_every_instruction_set(scene, widest);
}

/// Slivers before a wall, of which the floats' bounds and those of doubles say different things:
/// what is recorded must not depend on which is found first.
TEST(Determinism, of_slivers_before_a_wall_every_instruction_set_records_the_same) {
    Dice dice(27);
    for (int round = 0; round < 150; ++round) {
        const auto width = static_cast<float>(std::exp2(dice.between(-22, -19)));
        const auto gap = static_cast<float>(std::exp2(dice.between(-17, -13)));
        Scene scene = empty_scene(5);
        add_triangle(scene, {32, 0, -65 - gap}, {0, 0, -1 - gap}, {-0.25F, width, -0.5F - gap});
        // In sixteenths, so that the wall lies at -1 on the axis exactly.
        const auto slope = [&] { return static_cast<float>(dice.below(25)) / 16 - 0.75F; };
        const float along_x = slope();
        const float along_y = slope();
        const auto wall = [&](float x, float y) {
            return glm::vec3(x, y, -1 + along_x * x + along_y * y);
        };
        add_triangle(scene, wall(-1, -1), wall(1, -1), wall(0, 1));
        for (int i = 0; i < 60; ++i) {
            const auto side = [&] { return static_cast<float>(dice.between(-2, 2)); };
            const glm::vec3 at(side(), side(), static_cast<float>(dice.between(-4, -0.3)));
            if (std::abs(at.x) < 0.3F && std::abs(at.y) < 0.3F) continue;
            add_triangle(scene, at, at + glm::vec3(0.05F, 0, 0.02F),
                         at + glm::vec3(0, 0.05F, -0.02F));
        }
        finish(scene, true);
        scene.camera.near = 0.01;
        const GroundTruth widest = trace(Tracer(scene, 1));
        expect_same_with_every_instruction_set(scene, widest);
    }
}

TEST_P(DeterminismTest, exact_arithmetic_alone_finds_what_filters_find) {
    const Scene scene = GetParam().make();
    const Tracer tracer(scene);
    const GroundTruth filtered = trace(tracer);
    const GroundTruth exact = trace(tracer, Filters::off);
    EXPECT_EQ(exact.visibility.pixels, filtered.visibility.pixels);
    EXPECT_EQ(exact.triangle.pixels, filtered.triangle.pixels);
    EXPECT_EQ(exact.depth.pixels, filtered.depth.pixels);
    // Ties with what floats know to be hidden are found as well.
    EXPECT_GE(exact.statistics.degenerate, filtered.statistics.degenerate);
    // Where a surface is seen its three edges and its plane are asked for, at the least.
    const auto seen = exact.statistics.lit + exact.statistics.shadowed;
    EXPECT_GE(exact.statistics.exact_decisions, 4 * seen);
    EXPECT_GT(exact.statistics.exact_decisions, filtered.statistics.exact_decisions);
}

/// The exact signs must really be asked for, or the tests of hard scenes test floats.
TEST(Exactness, degenerate_scenes_are_decided_by_exact_arithmetic_and_say_so) {
    for (const HardScene& hard : hard_scenes()) {
        if (hard.name != "rays_through_vertices_and_edges" && hard.name != "coinciding_triangles" &&
            hard.name != "sun_along_edges")
            continue;
        const Scene scene = hard.make();
        const GroundTruth truth = trace(Tracer(scene));
        EXPECT_GT(truth.statistics.degenerate, 10U) << hard.name;
        EXPECT_GT(truth.statistics.exact_decisions, 10U) << hard.name;
    }
}

TEST(Exactness, an_ordinary_scene_is_decided_by_floats_nearly_everywhere) {
    for (const HardScene& hard : hard_scenes()) {
        if (hard.name != "soup_1" && hard.name != "sun_on_a_soup") continue;
        const Scene scene = hard.make();
        const GroundTruth truth = trace(Tracer(scene));
        EXPECT_EQ(truth.statistics.degenerate, 0U) << hard.name;
        EXPECT_LT(truth.statistics.exact_decisions, 10U) << hard.name;
    }
}

std::string test_name(const testing::TestParamInfo<HardScene>& scene) {
    std::string name = scene.param.name;
    std::ranges::replace(name, '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Reference, DeterminismTest, testing::ValuesIn(hard_scenes()), test_name);
INSTANTIATE_TEST_SUITE_P(Orthographic, DeterminismTest, testing::ValuesIn(orthographic_scenes()),
                         test_name);

} // namespace
} // namespace shadowproof
