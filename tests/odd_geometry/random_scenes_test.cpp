// Random scenes go through truth, all techniques and the judge; with each scene kept that once was
// unexplained, and beside it a fault that what explains it does not excuse.
//   SHADOWPROOF_SEEDS="FIRST COUNT" tries other seeds than the fixed ones.
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "tests/odd_geometry/random_scenes.h"
#include "tests/odd_geometry/tried.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <iostream>

namespace shadowproof::tests {
namespace {

constexpr Oddities from_casters{.eyes_on_casters = true};
constexpr Oddities on_quarters{.eyes_on_casters = true, .bodies_on_quarters = true};
constexpr Oddities larger{.scale = 6};
constexpr Oddities in_parallel{
    .eyes_on_casters = true, .bodies_on_quarters = true, .orthographic = true};
constexpr Oddities larger_in_parallel{.orthographic = true, .scale = 6};

void try_random_scenes(const Oddities& oddities, std::uint64_t count) {
    Gpu gpu(GlPlatform::osmesa);
    const Seeds seeds = seeds_to_try(count);
    int tried = 0;
    for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
        Dice dice(seed);
        Scene scene = random_scene(dice, oddities);
        SCOPED_TRACE(fmt::format("seed {}: {}", seed, scene.name));
        if (seeds.by_hand) std::cout << "seed " << seed << ": " << scene.name << std::endl;
        try {
            admit(scene);
        } catch (const Error& error) {
            EXPECT_TRUE(names_its_thing(error.what())) << error.what();
            continue;
        }
        ++tried;
        const TracedScene traced(std::move(scene));
        check_against_witness(traced, dice);
        try_techniques(traced, gpu);
    }
    EXPECT_GT(tried, static_cast<int>(seeds.count * 9 / 10));
}

/// Closed bodies and open soups, suns at noon, floors of 8 km; lights inside, on and next to
/// casters, and eyes inside them. Unexplained so far, of seeds beyond these: one counter of zfail
/// in 4143, under a lamp on an edge.
TEST(OddGeometry, random_scenes_are_refused_or_explained_to_the_last_pixel) {
    try_random_scenes({}, 500);
}

TEST(OddGeometry, random_scenes_seen_from_casters_are_refused_or_explained_to_the_last_pixel) {
    try_random_scenes(from_casters, 250);
}

TEST(OddGeometry, random_bodies_on_quarters_are_refused_or_explained_to_the_last_pixel) {
    try_random_scenes(on_quarters, 250);
}

/// More pixels meet more of what is rare.
TEST(OddGeometry, random_scenes_in_larger_pictures_are_refused_or_explained_to_the_last_pixel) {
    try_random_scenes(larger, 60);
}

/// Lines of sight through vertices, along edges and in planes of faces. Unexplained so far, of
/// seeds beyond these: 20724, where the lamp is between two vertices of casters, and finite volumes
/// end so near it that rounding parts a side from its far end.
TEST(OddGeometry, random_scenes_seen_in_parallel_are_refused_or_explained_to_the_last_pixel) {
    try_random_scenes(in_parallel, 400);
}

TEST(OddGeometry, random_scenes_in_larger_parallel_pictures_are_explained_to_the_last_pixel) {
    try_random_scenes(larger_in_parallel, 60);
}

Scene scene_of_seed(std::uint64_t seed, const Oddities& oddities) {
    Dice dice(seed);
    return random_scene(dice, oddities);
}

void try_kept(std::initializer_list<std::uint64_t> seeds, const Oddities& oddities) {
    Gpu gpu(GlPlatform::osmesa);
    for (const std::uint64_t seed : seeds) {
        SCOPED_TRACE(seed);
        try_techniques(TracedScene(scene_of_seed(seed, oddities)), gpu);
    }
}

/// What a technique draws of a scene; with `more` faces at the middle of the picture of volumes.
bool faces_are_explained(const TracedScene& traced, Frame frame, int more) {
    std::uint8_t& middle = frame.counted->volumes.at(12, 10);
    middle = static_cast<std::uint8_t>(middle + more);
    return compared(traced, frame).summary.unexplained.empty();
}

/// Where depths are clamped nothing is cut off before the near plane: a light cap in which the eye
/// lies is drawn over all of the picture, or over none of it. Half a thousandth away it is not
/// free.
TEST(OddGeometry, a_clamped_light_cap_around_the_eye_is_drawn_or_not_and_no_other_face_is) {
    try_kept({527}, {});
    try_kept({35, 268, 382}, from_casters);
    try_kept({3087}, {}); // the eye on an edge of two
    Gpu gpu(GlPlatform::osmesa);
    const Technique& technique = *find_technique("zfail_clamp");
    for (const std::uint64_t seed : {35U, 268U}) {
        SCOPED_TRACE(seed);
        const TracedScene on(scene_of_seed(seed, from_casters));
        const Frame frame = render(technique, on.scene, on.plan, gpu);
        EXPECT_TRUE(faces_are_explained(on, frame, 0));
        EXPECT_TRUE(faces_are_explained(on, frame, -1));
        EXPECT_FALSE(faces_are_explained(on, frame, 1));
        EXPECT_FALSE(faces_are_explained(on, frame, -2));
        Scene moved = on.scene;
        moved.camera.eye += glm::dvec3(5e-4);
        const TracedScene off(std::move(moved));
        const Frame exact = render(technique, off.scene, off.plan, gpu);
        EXPECT_TRUE(faces_are_explained(off, exact, 0));
        EXPECT_FALSE(faces_are_explained(off, exact, -1));
        EXPECT_FALSE(faces_are_explained(off, exact, 1));
    }
}

/// Expects a pixel that one technique draws to have the cause, and other counters there, but not
/// its own, to be caught.
void expect_cause(const TracedScene& traced, const char* technique, const Pixel& at, Cause cause,
                  std::initializer_list<std::uint32_t> others) {
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
    EXPECT_EQ(compared(traced, frame).cause.at(at.x, at.y), static_cast<std::uint8_t>(cause));
    EXPECT_FALSE(is_caught(traced, frame, at, frame.counted->counter.at(at.x, at.y)));
    for (const std::uint32_t other : others)
        EXPECT_TRUE(is_caught(traced, frame, at, other)) << other;
}

/// Its surface is not drawn there, and hides nothing.
TEST(OddGeometry, a_light_cap_before_the_near_plane_is_in_front_of_what_is_seen) {
    try_kept({1167}, {});
    try_kept({163}, from_casters);
    try_kept({142}, on_quarters);
    expect_cause(TracedScene(scene_of_seed(163, from_casters)), "zfail_reversed", {23, 4},
                 Cause::precision, {1, 2, 254});
    expect_cause(TracedScene(scene_of_seed(142, on_quarters)), "zfail_no_light_cap", {9, 6},
                 Cause::cap, {0, 2, 255});
    expect_cause(TracedScene(scene_of_seed(1167, {})), "zfail_no_light_cap", {17, 5}, Cause::cap,
                 {0, 2, 255});
}

/// The near plane cuts off a light cap at 0.267408048, for certain, and by rounding not the side
/// behind it at 0.267408055.
TEST(OddGeometry, a_face_that_a_rounded_near_plane_leaves_is_lost_with_the_near_plane) {
    try_kept({2133}, {});
    expect_cause(TracedScene(scene_of_seed(2133, {})), "zpass", {10, 18}, Cause::near_plane,
                 {1, 2, 254});
}

/// Two caps meet in a silhouette, and beside it their order is open. Without rounding the count is
/// the truth's, of a technique that fills holes and so counts otherwise than the ideal one.
TEST(OddGeometry, what_only_rounding_makes_wrong_of_filled_holes_is_precision) {
    try_kept({2698, 2746, 2759}, {});
    expect_cause(TracedScene(scene_of_seed(2698, {})), "zfail_half_edge", {17, 15},
                 Cause::precision, {3, 200});
}

/// A triangle that fills a hole lies in the plane of the surface shown: it may be drawn in front of
/// it or behind it.
TEST(OddGeometry, a_light_cap_in_the_plane_of_the_surface_comes_before_it_or_after_it) {
    try_kept({1433}, from_casters);
    expect_cause(TracedScene(scene_of_seed(1433, from_casters)), "zfail_half_edge", {14, 5},
                 Cause::precision, {2, 3, 255});
}

/// Without a dark cap, a volume's far end is an outline. Two sides end at infinity there, one
/// entered and one left, each of which may be counted.
TEST(OddGeometry, the_vanishing_line_of_a_side_is_an_outline_of_a_volume_without_a_dark_cap) {
    try_kept({3389}, on_quarters);
    const TracedScene traced(scene_of_seed(3389, on_quarters));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame =
        render(*find_technique("zfail_no_dark_cap"), traced.scene, traced.plan, gpu);
    for (const std::uint32_t counter : {0U, 1U, 2U})
        EXPECT_FALSE(is_caught(traced, frame, {23, 1}, counter)) << counter;
    for (const std::uint32_t counter : {3U, 254U, 255U})
        EXPECT_TRUE(is_caught(traced, frame, {23, 1}, counter)) << counter;
    EXPECT_TRUE(is_caught(traced, frame, {22, 1}, 0)) << "a pixel from the line";
}

/// Expects a pixel's counters that may be read, and others to be caught; a step aside is not free.
void expect_free(const TracedScene& traced, const char* technique, const Pixel& at,
                 std::initializer_list<std::uint32_t> free,
                 std::initializer_list<std::uint32_t> others, const Pixel& aside) {
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
    for (const std::uint32_t counter : free)
        EXPECT_FALSE(is_caught(traced, frame, at, counter)) << counter;
    for (const std::uint32_t counter : others)
        EXPECT_TRUE(is_caught(traced, frame, at, counter)) << counter;
    const std::uint32_t read = frame.counted->counter.at(aside.x, aside.y);
    for (const std::uint32_t counter : {read + 1, read + 2, (read + 255) % 256})
        EXPECT_TRUE(is_caught(traced, frame, aside, counter)) << "aside: " << counter;
}

/// The lamp lies in the plane of a prism's end, but for rounding: at infinity, the end's triangles
/// lie on one line, and their dark caps have no area from which a depth could follow. One of them
/// is drawn at the pixel, and not behind the background.
TEST(OddGeometry, a_dark_cap_without_area_is_drawn_at_any_depth) {
    try_kept({2496}, {});
    expect_free(TracedScene(scene_of_seed(2496, {})), "zfail_reversed", {10, 7}, {255, 0, 1, 2},
                {3, 4, 253, 254}, {10, 8});
}

/// The lamp lies an ulp from the end of an edge: the side over it has no area, either.
TEST(OddGeometry, a_side_over_an_edge_that_points_at_the_light_is_drawn_at_any_depth) {
    try_kept({2868}, {});
    expect_free(TracedScene(scene_of_seed(2868, {})), "zfail_clamp", {20, 9}, {254, 255, 0, 1, 2},
                {3, 4, 252, 253}, {21, 10});
}

/// The lamp is a corner of a star's end: the light sees its triangles edge-on, and what lies of
/// them before the near plane is slivers there, three of which cover the pixel.
TEST(OddGeometry, a_layer_in_the_near_plane_that_is_a_sliver_is_counted_or_not) {
    expect_free(TracedScene(scene_of_seed(21406, larger)), "zp_plus", {60, 21}, {0, 1, 2, 3},
                {4, 5, 254, 255}, {61, 22});
}

/// What is seen through a gap between a surface and the background is seen on no ray: whether it is
/// truly lit follows from its own shadow depth, not from the background.
TEST(OddGeometry, what_shows_through_a_gap_is_judged_by_its_own_truth) {
    const TracedScene traced(scene_of_seed(20121, larger));
    expect_cause(traced, "zfail_no_light_cap", {51, 61}, Cause::cap, {2, 255});
    expect_cause(traced, "zfail_saturate", {51, 61}, Cause::counter, {2, 255});
}

/// The lamp lies in the plane of a prism's end, whose volumes of finite length lie in that plane,
/// too, and are empty: no depth suffices to tell their faces from the end.
TEST(OddGeometry, a_flat_volume_in_the_surface_excuses_precision_at_any_depth) {
    const TracedScene traced(scene_of_seed(21112, larger));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_truncated"), traced.scene, traced.plan, gpu);
    const Comparison comparison = compared(traced, frame);
    EXPECT_EQ(pixels_of(comparison, Cause::precision), 29U);
    EXPECT_EQ(comparison.too_near, 0U);
    EXPECT_FALSE(is_caught(traced, frame, {77, 43}, 0));
    for (const std::uint32_t counter : {3U, 252U})
        EXPECT_TRUE(is_caught(traced, frame, {77, 43}, counter)) << counter;
}

/// Seen from the ray's plane, a triangle is met or not, even beyond the ray's end.
TEST(OddGeometry, a_shadow_ray_in_a_triangles_plane_may_stop_at_it) {
    try_kept({422, 650}, from_casters);
}

/// Before the near plane depths are clamped to its own, and are no longer before what lies in it.
/// No other counter is free for that, nor that one to hold anything.
TEST(OddGeometry, faces_clamped_to_the_near_plane_are_behind_what_lies_in_it) {
    try_kept({20448, 20486, 20827}, in_parallel);
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(scene_of_seed(20486, in_parallel));
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    const auto with_counter = [&](int x, std::uint32_t count) {
        Frame other = frame;
        other.counted->counter.at(x, 10) = count;
        return compared(traced, other).evidence.unexplained;
    };
    EXPECT_EQ(with_counter(11, 1), 0U) << "the exact count";
    EXPECT_EQ(with_counter(11, 7), 1U);
    EXPECT_EQ(with_counter(12, frame.counted->counter.at(12, 10) + 1), 1U);
}

/// A side that lies along all lines of sight is crossed at infinity, which finite volumes do not
/// reach.
TEST(OddGeometry, finite_volumes_hold_no_end_of_parallel_lines_of_sight) {
    try_kept({21196}, in_parallel);
}

} // namespace
} // namespace shadowproof::tests
