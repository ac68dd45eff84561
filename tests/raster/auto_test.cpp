// What auto leaves out, and what the volumes of a frame are said to cost.
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "tests/raster/small_scenes.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

namespace shadowproof::tests {
namespace {

Scene small(const char* name) {
    return load_scene(name, {.camera = {}, .light = {}, .time = 0, .width = 128, .height = 128});
}

Frame draw(Gpu& gpu, const Scene& scene, const char* technique) {
    return render(*find_technique(technique), scene, make_plan(scene), gpu);
}

Counting::Caster counted_as(const Scene& scene, const Frame& frame, std::string_view mesh) {
    const auto found = std::ranges::find(scene.meshes, mesh, &Mesh::name);
    return frame.counted->counting.caster(found->first_triangle);
}

std::size_t differing_claims(const Frame& frame, const Frame& other) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
        differing += frame.claim.pixels[i] != other.claim.pixels[i] ? 1U : 0U;
    return differing;
}

/// Pixels that face the light of which one counter says lit and the other shadowed.
std::size_t differing_shadows(const Scene& scene, const Frame& frame, const Frame& other) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < frame.counted->counter.pixels.size(); ++i) {
        const std::uint32_t seen = frame.triangle.pixels[i];
        if (seen == no_triangle || seen != other.triangle.pixels[i]) continue;
        const glm::dvec4 light = homogeneous(chosen_light(scene));
        const double facing =
            side(scene, seen, light) * side(scene, seen, glm::dvec4(scene.camera.eye, 1));
        if (facing <= 0) continue;
        differing +=
            (frame.counted->counter.pixels[i] == 0) != (other.counted->counter.pixels[i] == 0) ? 1U
                                                                                               : 0U;
    }
    return differing;
}

// Sides that are left out, or of which other depths are asked, no longer round a pixel.
constexpr std::size_t few = 4;

TEST(Auto, counts_a_caster_behind_the_surface_where_its_volume_holds_the_eye_and_no_other) {
    const Scene scene = small("seen_shadow");
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = draw(gpu, scene, "auto");
    EXPECT_EQ(counted_as(scene, frame, "plank").test, Counting::Test::depth_fail);
    EXPECT_FALSE(counted_as(scene, frame, "plank").left_out);
    EXPECT_EQ(counted_as(scene, frame, "apple").test, Counting::Test::depth_pass);
    EXPECT_FALSE(frame.depth_model.finite());
    EXPECT_LE(differing_claims(frame, draw(gpu, scene, "zfail_reversed")), few);
    EXPECT_GT(differing_claims(frame, draw(gpu, scene, "zpass")), 1000U); // which cannot do it
}

TEST(Auto, leaves_out_the_volume_around_the_eye_where_nothing_seen_is_in_it) {
    const Scene scene = small("eye_inside");
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = draw(gpu, scene, "auto");
    EXPECT_TRUE(counted_as(scene, frame, "canopy").left_out);
    EXPECT_TRUE(counted_as(scene, frame, "floor").left_out);
    EXPECT_FALSE(counted_as(scene, frame, "torus").left_out);
    EXPECT_TRUE(frame.depth_model.finite()); // nothing behind the surface is asked for
    EXPECT_LE(differing_claims(frame, draw(gpu, scene, "zfail_reversed")), few);
}

class AutoClaims : public testing::TestWithParam<std::string> {};

TEST_P(AutoClaims, are_those_of_zfail_reversed_but_for_depths_that_tie) {
    const Scene scene = small(GetParam().c_str());
    Gpu gpu(GlPlatform::osmesa);
    const Frame whole = draw(gpu, scene, "zfail_reversed");
    const Frame frame = draw(gpu, scene, "auto");
    EXPECT_LE(differing_claims(frame, whole), few);
    // Whether a counter is zero is what must be kept: a volume that is left out changes others.
    EXPECT_LE(differing_shadows(scene, frame, whole), few);
    EXPECT_LE(frame.counted->volume_fragments, whole.counted->volume_fragments);
    ASSERT_TRUE(frame.counted->saved.has_value());
    EXPECT_EQ(frame.counted->saved->against, "zfail_reversed");
    EXPECT_EQ(frame.counted->saved->volume_fragments,
              static_cast<std::int64_t>(whole.counted->volume_fragments -
                                        frame.counted->volume_fragments));
    EXPECT_FALSE(frame.left_out.empty());
}

INSTANTIATE_TEST_SUITE_P(Bundled, AutoClaims, testing::ValuesIn(tests::bundled_scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(Auto, draws_no_volume_where_no_caster_can_shadow_anything) {
    Scene scene = empty_scene();
    add_rectangle(scene, {-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2});
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = draw(gpu, scene, "auto");
    EXPECT_EQ(frame.counted->volume_fragments, 0U);
    EXPECT_TRUE(
        std::ranges::all_of(frame.counted->counter.pixels, [](auto count) { return count == 0; }));
    EXPECT_GT(draw(gpu, scene, "zfail_reversed").counted->volume_fragments, 0U);
}

// Past the far plane, casters are no surfaces, and under a projection without one their light caps
// are in front of the background: they must be drawn wherever faces in front are counted.
TEST(Auto, draws_the_light_caps_of_casters_past_the_far_plane_in_a_picture_without_one) {
    Scene scene = empty_scene();
    add_rectangle(scene, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20});
    add_box(scene, {-1, 1.5, -13}, {1, 3.5, -11});
    add_box(scene, {-1.5, 2.45F, -6}, {3, 2.6F, 1.5}); // its volume meets the near plane
    scene.lights[0].position = {0, 6, -19};
    look_at(scene.camera, {0, 1.5, 6}, {0, 0, 0});
    scene.camera.far = 14;
    scene.camera.width = scene.camera.height = 128;
    for (const bool double_sided : {false, true}) {
        scene.materials[0].double_sided = double_sided;
        Gpu gpu(GlPlatform::osmesa);
        const Frame frame = draw(gpu, scene, "auto");
        EXPECT_FALSE(frame.depth_model.finite());
        EXPECT_EQ(counted_as(scene, frame, "mesh 1").test, Counting::Test::depth_pass);
        const Frame whole = draw(gpu, scene, "zfail_reversed");
        EXPECT_LE(differing_claims(frame, whole), few);
        EXPECT_LE(differing_shadows(scene, frame, whole), few);
    }
}

// A shell that is wound inwards within a mesh that is wound outwards as a whole: nothing of the
// mesh lies in front of what is culled of it.
TEST(Auto, draws_the_light_caps_of_a_shell_wound_inwards) {
    Scene scene = empty_scene();
    add_rectangle(scene, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20});
    add_box(scene, {3.1F, 1.1F, -3.9F}, {4.9F, 2.9F, -2.1F});
    add_box(scene, {-0.5, 1.5, -0.5}, {0.5, 2.5, 0.5});
    for (std::size_t i = scene.triangles.size() - 12; i < scene.triangles.size(); ++i)
        std::swap(scene.triangles[i].y, scene.triangles[i].z);
    scene.meshes.pop_back();
    scene.meshes.back().triangle_count = 24;
    scene.lights[0].position = {0, 6, 4};
    look_at(scene.camera, {0, 0.5, 6}, {0, 1.5, 0});
    scene.camera.width = scene.camera.height = 128;
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = draw(gpu, scene, "auto");
    const Frame whole = draw(gpu, scene, "zfail_reversed");
    EXPECT_LE(differing_claims(frame, whole), few);
    EXPECT_LE(differing_shadows(scene, frame, whole), few);
    // Its caps are in front of what is seen: without them, the claim is another.
    EXPECT_GT(differing_claims(draw(gpu, scene, "zfail_no_light_cap"), whole), 100U);
}

TEST(Volumes, a_box_over_a_floor_shows_the_faces_that_nothing_hides) {
    const Scene scene = box_over_floor();
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = draw(gpu, scene, "zfail_reversed");
    const std::uint64_t shown =
        std::accumulate(frame.counted->volumes.pixels.begin(), frame.counted->volumes.pixels.end(),
                        std::uint64_t{0});
    EXPECT_GT(shown, 0U);
    EXPECT_LT(shown, frame.counted->volume_fragments); // some are hidden
    // Each method draws the same faces.
    for (const char* technique : {"zfail_half_edge", "zfail_float"}) {
        const Frame other = draw(gpu, scene, technique);
        EXPECT_EQ(other.counted->volumes.pixels, frame.counted->volumes.pixels) << technique;
        EXPECT_EQ(other.counted->volume_fragments, frame.counted->volume_fragments) << technique;
    }
    EXPECT_GT(draw(gpu, scene, "zfail_per_triangle").counted->volume_fragments,
              frame.counted->volume_fragments);
    EXPECT_LT(draw(gpu, scene, "zfail_no_light_cap").counted->volume_fragments,
              frame.counted->volume_fragments);
}

TEST(Counter, a_floating_point_sum_counts_past_what_eight_bits_hold) {
    const Scene scene = small("nested");
    Gpu gpu(GlPlatform::osmesa);
    const Frame sum = draw(gpu, scene, "zfail_float");
    const Frame stencil = draw(gpu, scene, "zfail_reversed");
    EXPECT_GT(*std::ranges::max_element(sum.counted->counter.pixels), 256U);
    for (std::size_t i = 0; i < sum.counted->counter.pixels.size(); ++i)
        ASSERT_EQ(sum.counted->counter.pixels[i] & 0xffU, stencil.counted->counter.pixels[i]);
}

} // namespace
} // namespace shadowproof::tests
