// Mutation goes through admission, truth, all techniques and the judge.
//   SHADOWPROOF_SEEDS="FIRST COUNT" tries other seeds than the fixed ones.
#include "compare/verdict.h"
#include "reference/witness/witness.h"
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"
#include "tests/odd_geometry/mutations.h"
#include "tests/raster/small_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>
#include <iostream>
#include <sstream>

namespace shadowproof::tests {
namespace {

struct Seeds {
    std::uint64_t first = 1;
    std::uint64_t count = 1000;
    bool by_hand = false; ///< then each is said as it is tried
};

Seeds seeds_to_try() {
    Seeds seeds;
    if (const char* given = std::getenv("SHADOWPROOF_SEEDS"); given != nullptr)
        seeds.by_hand = bool(std::istringstream(given) >> seeds.first >> seeds.count);
    return seeds;
}

bool names_its_thing(const std::string& message) {
    const auto says = [&](const char* words) { return message.find(words) != std::string::npos; };
    return (says("vertex") && says("mesh \"")) || says("the camera") || says("the light");
}

/// A few pixels against brute force over rationals, which takes no size of number for special.
void check_against_witness(const TracedScene& traced, Dice& dice) {
    const witness::Witness witness(traced.scene);
    const Camera& camera = traced.scene.camera;
    for (int i = 0; i < 4; ++i) {
        const int x = static_cast<int>(dice.below(static_cast<std::uint64_t>(camera.width)));
        const int y = static_cast<int>(dice.below(static_cast<std::uint64_t>(camera.height)));
        const witness::Answer expected = witness.look(ray_direction(camera, x + 0.5, y + 0.5));
        EXPECT_EQ(traced.truth.triangle.at(x, y), expected.triangle) << "at " << x << ", " << y;
        EXPECT_EQ(traced.truth.visibility.at(x, y), expected.visibility) << "at " << x << ", " << y;
    }
}

std::string words_of(const Comparison& comparison) {
    std::string words;
    for (const CauseWords& cause : all_causes)
        if (const std::uint64_t pixels = pixels_of(comparison, cause.cause); pixels > 0)
            words += fmt::format(" {} {}", pixels, cause.name);
    if (comparison.evidence.unexplained > 0)
        words += fmt::format(", {} counters unexplained, first at ({},{})",
                             comparison.evidence.unexplained, comparison.evidence.first_x,
                             comparison.evidence.first_y);
    if (comparison.first)
        words += fmt::format(", first at ({},{})", comparison.first->x, comparison.first->y);
    return words;
}

void try_technique(const Technique& technique, const TracedScene& traced, Gpu& gpu) {
    SCOPED_TRACE(technique.name);
    try {
        const Comparison comparison = compared(traced, technique, gpu);
        const Verdict verdict =
            judge(traced.scene, technique.fails_at, technique.by_nature, comparison);
        EXPECT_TRUE(verdict == Verdict::agrees || verdict == Verdict::fails_as_predicted)
            << "FAULT " << technique.name << " " << name_of(verdict) << ":" << words_of(comparison);
    } catch (const Error& error) {
        ADD_FAILURE() << "FAULT " << technique.name << " refused: " << error.what();
    }
}

void try_techniques(const TracedScene& traced, Gpu& gpu) {
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, traced.scene)) continue;
        if (technique.name == "cube_map_geometry_shader")
            continue; // its maps are those of six passes
        try_technique(technique, traced, gpu);
    }
}

void try_seed(std::uint64_t seed, bool by_hand, const std::vector<Scene>& scenes, Gpu& gpu) {
    Dice dice(seed);
    Scene scene = dice.one_of(scenes);
    std::string what = scene.name;
    for (const std::string& step : mutate(scene, dice)) what += "; " + step;
    SCOPED_TRACE(fmt::format("seed {}: {}", seed, what));
    if (by_hand) std::cout << "seed " << seed << ": " << what << std::endl;
    const bool finite = is_finite(scene);
    try {
        admit(scene);
    } catch (const Error& error) {
        EXPECT_TRUE(names_its_thing(error.what())) << error.what();
        return;
    }
    EXPECT_TRUE(finite) << "was admitted";
    if (!finite) return;
    const TracedScene traced(std::move(scene));
    check_against_witness(traced, dice);
    try_techniques(traced, gpu);
}

Scene odd_scene(const char* file, int size) {
    SceneRequest request;
    request.width = request.height = size;
    return load_scene(std::string(ODD_SCENES) + "/" + file, request);
}

TEST(OddGeometry, mutated_scenes_are_refused_or_explained_to_the_last_pixel) {
    const std::vector<Scene> scenes = scenes_to_mutate();
    Gpu gpu(GlPlatform::osmesa);
    const Seeds seeds = seeds_to_try();
    for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed)
        try_seed(seed, seeds.by_hand, scenes, gpu);
}

void try_seeds(std::initializer_list<std::uint64_t> seeds) {
    const std::vector<Scene> scenes = scenes_to_mutate();
    Gpu gpu(GlPlatform::osmesa);
    for (const std::uint64_t seed : seeds) try_seed(seed, false, scenes, gpu);
}

TEST(OddGeometry, an_eye_on_a_caster_or_on_an_edges_line_is_explained) {
    try_seeds({16, 31, 131, 178, 263, 285, 329, 375, 406, 6043});
}

TEST(OddGeometry, a_light_inside_a_closed_caster_is_explained) {
    try_seeds({138, 433});
}

TEST(OddGeometry, triangles_that_doubles_see_from_the_wrong_side_are_explained) {
    try_seeds({253, 417});
}

TEST(OddGeometry, a_triangle_with_one_corner_far_away_has_its_true_depth_near_by) {
    try_seeds({204});
}

TEST(OddGeometry,
     figures_of_a_near_plane_of_1e_16_and_of_a_caster_flat_from_the_light_are_explained) {
    try_seeds({155, 422});
}

/// A value that is no zero, and beside which every other coordinate is as good as exact. Both
/// techniques go by edges between triangles, whose planes no longer are what they look like.
TEST(OddGeometry, a_prism_with_any_three_of_its_coordinates_at_1e_20_is_explained) {
    const Scene plain = prism_over_floor();
    Gpu gpu(GlPlatform::osmesa);
    constexpr int coordinates = 6 * 3;
    for (int i = 0; i < coordinates; ++i)
        for (int j = i + 1; j < coordinates; ++j)
            for (int k = j + 1; k < coordinates; ++k) {
                SCOPED_TRACE(fmt::format("coordinates {}, {} and {}", i, j, k));
                Scene scene = plain;
                for (const int each : {i, j, k})
                    scene.positions[static_cast<std::size_t>(each / 3)][each % 3] = 1e-20F;
                const TracedScene traced(std::move(scene));
                for (const char* name : {"zfail_half_edge", "zfail_degenerate_quads"})
                    try_technique(*find_technique(name), traced, gpu);
            }
}

TEST(OddGeometry, a_tiny_scene_with_one_huge_coordinate_is_refused) {
    try_seeds({533});
}

/// A corner 1e14 and more times as far away as all others; a light 5e-324 from a plane.
TEST(OddGeometry, numbers_beside_which_others_vanish_are_refused) {
    try_seeds({93, 639, 779, 928, 981});
}

/// The floor's own volume is as thick as an atom's ten-millionth part.
TEST(OddGeometry, a_light_1e18_away_and_6_above_the_floors_plane_is_explained) {
    try_seeds({713});
}

/// Pixel (8, 17) shows a back of a triangle that no ray around it meets.
TEST(OddGeometry, a_back_beside_the_pixel_that_no_map_is_asked_about_is_explained) {
    try_seeds({50});
}

TEST(OddGeometry, a_floor_of_393_km_under_the_feet_is_explained) {
    Gpu gpu(GlPlatform::osmesa);
    try_techniques(TracedScene(odd_scene("large_floor.gltf", 24)), gpu);
}

/// A node scaled by 2^44: the clipper draws its floor elsewhere. The counterpart is
/// WideFloor.is_not_lost_where_the_clipper_holds_it.
TEST(OddGeometry, a_floor_of_1e13_that_the_clipper_loses_is_explained) {
    Gpu gpu(GlPlatform::osmesa);
    try_techniques(TracedScene(odd_scene("huge_extent.gltf", 24)), gpu);
}

/// The counter that a technique reads at a pixel, instead of what it drew: whether that is caught.
bool is_caught(const TracedScene& traced, Frame frame, const Pixel& at, std::uint32_t counter) {
    frame.counted->counter.at(at.x, at.y) = counter;
    return compared(traced, frame).evidence_miss.at(at.x, at.y) == 1;
}

/// A floor 2e10 wide under a box: the clipper draws it elsewhere, and so its light cap, while the
/// dark cap at infinity stays. Pixel (9, 8) shows the box before it, and counts the dark cap alone.
TEST(OddGeometry, a_light_cap_that_the_clipper_loses_is_counted_or_not) {
    const TracedScene traced(odd_scene("vast_floor.gltf", 24));
    Gpu gpu(GlPlatform::osmesa);
    try_techniques(traced, gpu);
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    EXPECT_EQ(frame.counted->counter.at(9, 8), 1U);
    EXPECT_FALSE(is_caught(traced, frame, {9, 8}, 0));
    EXPECT_FALSE(is_caught(traced, frame, {9, 8}, 1));
    EXPECT_TRUE(is_caught(traced, frame, {9, 8}, 3));
    EXPECT_TRUE(
        is_caught(traced, frame, {9, 8}, 253)); // 254: both of its light caps come out flipped
}

/// Floors of 1e3 to 1e8 beside a camera's height of 3, with triangles without area among them; a
/// solid that is stretched by 1e7; sides of volumes whose planes pass the eye. Found by fuzzing.
TEST(OddGeometry, what_floats_displace_by_pixels_is_explained) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* file : {"side_through_eye.gltf", "eye_in_floor.gltf", "floor_cut_by_far.gltf",
                             "floor_beyond_far.gltf", "spot_on_wide_floor.gltf",
                             "stretched_solid.gltf", "folded_floor.gltf", "widest_floor.gltf"}) {
        SCOPED_TRACE(file);
        try_techniques(TracedScene(odd_scene(file, 24)), gpu);
    }
}

/// The planes of three sides pass the eye closer than floats tell at 1.7e7: each may be drawn over
/// half of the picture, or over the other half, or before the near plane. There are no others.
TEST(OddGeometry, sides_next_to_the_eye_are_counted_or_not) {
    const TracedScene traced(odd_scene("side_through_eye.gltf", 24));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zpass"), traced.scene, traced.plan, gpu);
    EXPECT_EQ(frame.counted->counter.at(2, 0), 255U);
    for (const std::uint32_t counter : {255U, 0U, 1U})
        EXPECT_FALSE(is_caught(traced, frame, {2, 0}, counter)) << counter;
    for (const std::uint32_t counter : {4U, 5U, 128U, 251U, 252U})
        EXPECT_TRUE(is_caught(traced, frame, {2, 0}, counter)) << counter;
}

/// Pixel (20, 13) lies beside the volume of a sliver, a ten-thousandth of a pixel wide there, and
/// is drawn within it.
TEST(OddGeometry, a_volume_that_is_a_ten_thousandth_of_a_pixel_wide_is_counted_or_not) {
    const TracedScene traced(odd_scene("askew_label.gltf", 32));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail_reversed"), traced.scene, traced.plan, gpu);
    EXPECT_EQ(compared(traced, frame).evidence.unexplained, 0U);
    EXPECT_FALSE(is_caught(traced, frame, {20, 13}, 1));
    EXPECT_FALSE(is_caught(traced, frame, {20, 13}, 2));
    EXPECT_TRUE(is_caught(traced, frame, {20, 13}, 0));
    EXPECT_TRUE(is_caught(traced, frame, {20, 13}, 3));
    EXPECT_TRUE(is_caught(traced, frame, {19, 13}, 2)) << "a pixel from the sliver";
}

} // namespace
} // namespace shadowproof::tests
